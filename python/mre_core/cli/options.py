"""Options that several commands share."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click

from ..errors import InputError
from ..files import ReadOptions
from .settings import read_config

F = TypeVar("F", bound=Callable[..., Any])


class Whole(click.types.IntParamType):
    """Whole numbers that the core can take; their ranges are checked there, and need no mention in help."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Convert a text."""
        number = super().convert(value, param, ctx)
        if not -(2**63) <= number < 2**63:
            self.fail(f"{value} has too many digits, wanted a whole number below 2^63", param, ctx)
        return number


WHOLE = Whole()


def config_option(command: F) -> F:
    """Option of every command that has settings."""
    return click.option(
        "--config",
        type=click.Path(path_type=Path),
        is_eager=True,
        expose_value=False,
        callback=read_config,
        metavar="F.toml",
        help="Options from a TOML file; those given here win.",
    )(command)


def cluster_option(command: F) -> F:
    """Where the items of a batch are worked on."""
    return click.option(
        "--cluster", metavar="ADDRESS|local:N", help="A Dask scheduler, or N Dask workers on this machine."
    )(command)


def common_options(command: F) -> F:
    """Options of every command that reads recordings."""
    options = [
        click.option(
            "--map",
            "mapping",
            multiple=True,
            metavar="ROLE=COLUMN[UNIT]",
            help="Column of a role, and its unit.",
        ),
        click.option(
            "--set",
            "conditions",
            multiple=True,
            metavar="ROLE=VALUE[UNIT]",
            help="Current or temperature of all recordings.",
        ),
        click.option(
            "--name-pattern",
            metavar="PATTERN",
            help="Form of the file names, such as '{amplitude}mm{frequency}Hz{current}A'.",
        ),
        click.option(
            "--read",
            "reading",
            multiple=True,
            metavar="KEY=VALUE",
            help=f"How to read the files: {', '.join(ReadOptions._fields)}.",
        ),
    ]
    command = config_option(command)
    for option in reversed(options):
        command = option(command)
    return command


def report_options(command: F) -> F:
    """Options of every command that shows results."""
    quiet = click.option("--quiet", is_flag=True, help="No progress, no tables.")
    as_json = click.option("--json", "as_json", is_flag=True, help="Results as JSON on standard output.")
    return as_json(quiet(command))


def check_quiet(out: Path | None, *, as_json: bool, quiet: bool) -> None:
    """Refuse long work of which nothing would be left."""
    if quiet and not as_json and out is None:
        raise InputError("--quiet prints nothing", wanted="--out or --json beside it: nothing would be kept")


def trim_options(command: F) -> F:
    """Options of every command that may leave parts of recordings out."""
    cut = click.option("--cut", metavar="START:STOP", help="Keep this part of every recording, in s.")
    exclude = click.option(
        "--exclude", metavar="PARTS", help="start_transient, stop_transient or both, with a comma."
    )
    return cut(exclude(command))


def fit_options(command: F) -> F:
    """Options of every command that fits the parameters of a model."""
    bounds = click.option(
        "--bounds", multiple=True, metavar="NAME=LOWER:UPPER", help="Bounds that replace default ones."
    )
    weights = click.option(
        "--weights", metavar="samples|force", help="Count samples, or recordings by their force."
    )
    return bounds(weights(command))
