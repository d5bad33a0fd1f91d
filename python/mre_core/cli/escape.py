"""Text out of files, for a terminal."""

from ..errors import one_line


def escape(text: str) -> str:
    """Make it show as it is: no markup of ours, no command to the terminal.

    Parameters
    ----------
    text : str
        Any text.

    Returns
    -------
    str
        What to print with markup.
    """
    from rich.markup import escape as without_markup

    return without_markup(one_line(text))
