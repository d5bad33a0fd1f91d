"""What tells two effects apart beside a motion of the device: a measurement, or another thing to move."""

_CHANNELS = {"filter_lag", "time_delay"}
_SPRING = "drive a steel spring in the place of the device: what a channel does to the force is still there"


def check(one: str, other: str) -> str | None:
    """Say how to tell one effect from another; ``None`` where nothing simple does.

    Parameters
    ----------
    one, other : str
        Ids of effects.
    """
    pair = {one, other}
    if "rig_compliance" in pair:
        return (
            "measure the displacement between the plates of the device itself: "
            "what a compliant fixture does is gone then"
        )
    if "inertia" in pair:
        return (
            "weigh what moves between the load cell and the device, and the moving parts of the device: "
            "a mass is no more than that"
        )
    if pair == _CHANNELS:
        return (
            "drive a steel spring as fast as the machine can: "
            "a filter lowers the amplitude of its force, a delay does not"
        )
    if pair & _CHANNELS:
        return _SPRING
    if pair == {"thermal_softening", "cyclic_degradation"}:
        return "repeat the first recording after hours of rest: heat is gone then, wear is still there"
    return None
