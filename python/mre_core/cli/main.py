"""Entry point: dispatch, exit status, and errors in one line.

Exit status: 0 done, 2 input or options wrong, 130 interrupted, 1 anything else.
"""

import errno
import logging
import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from io import TextIOWrapper
from typing import TextIO

import click

from .. import __version__
from ..checks import is_text
from ..errors import MreError, one_line, shown
from ..interruption import Interruptions
from .arguments import spread
from .batch import batch
from .demo import demo
from .diagnose import diagnose
from .identify import identify
from .inspect import inspect
from .laws import laws
from .loops import loops
from .next_test import next_test
from .schema import schema
from .simulate import simulate
from .study import study
from .trial import trial

_DEBUG = "MRE_CORE_TRACEBACK"
_OPTIONS = {"n_fish": "fish", "n_particles": "fish", "max_iterations": "iterations"}
"""Options that are called otherwise in Python, where what is wrong with them is found."""
_FULL = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG}


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(__version__, prog_name="mre-core")
def cli() -> None:
    """Identify hysteresis models of magnetorheological elastomer isolators and dampers.

    \b
    Examples:
      mre-core demo
      mre-core inspect test.txt --write-config test.toml
      mre-core identify test.csv --model sinh --out result
      mre-core diagnose test.csv --base sinh --out result
      mre-core loops test.csv --model result/model.json --out loops
      mre-core simulate result/model.json earthquake.csv --out predicted.csv
      mre-core laws *.csv --model sinh --out result
      mre-core batch recordings --model sinh --out results
    """  # noqa: D301  # \b keeps the lines


COMMANDS = (inspect, identify, diagnose, loops, laws, next_test, batch, simulate, demo, study, trial, schema)
for command in COMMANDS:
    cli.add_command(command)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit status."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        with _settled():
            status = _run(given)
        print(end="", flush=True)
        return status
    except BrokenPipeError:  # whoever read the output has seen enough
        _give_up(sys.stdout)
        return 1
    except OSError as error:
        if error.errno not in _FULL:
            return _unforeseen(error)
        _give_up(sys.stdout)
        return _fail(f"the output cannot be written: {error.strerror}, wanted room for it", 1)


@contextmanager
def _settled() -> Iterator[None]:
    """Take from the surroundings what would stop a command after its work."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):  # one that knows few letters shows a question mark
            stream.reconfigure(errors="replace")
    backend = os.environ.pop("MPLBACKEND", None)  # figures go to files: it only could be wrong
    try:
        if os.path.lexists("matplotlibrc"):  # of a stranger's folder: it could ask for LaTeX
            logging.getLogger("matplotlib").setLevel(logging.ERROR)
            import matplotlib

            matplotlib.rcdefaults()
        yield
    finally:
        if backend is not None:
            os.environ["MPLBACKEND"] = backend


def _run(given: list[str]) -> int:
    signals = Interruptions()
    try:
        with signals, warnings.catch_warnings():
            warnings.simplefilter("default")
            # An interruption in the middle of an import leaves a file of the interpreter to it.
            warnings.simplefilter("ignore", ResourceWarning)
            warnings.showwarning = _show_warning
            status = cli.main(spread(given), prog_name="mre-core", standalone_mode=False)
        return status if isinstance(status, int) else 0
    except click.exceptions.Exit as stop:
        return stop.exit_code
    except click.exceptions.NoArgsIsHelpError as error:
        print(error.format_message())
        return 0
    except click.MissingParameter as error:
        return _fail(_missing(error), 2)
    except click.ClickException as error:
        return _fail(error.format_message(), 2)
    except MreError as error:
        name, *rest = str(error).split(" ", 1)
        return _fail(" ".join([_OPTIONS.get(name, name), *rest]), 2)
    except UnicodeEncodeError as error:
        if all(map(is_text, given)):
            return _unforeseen(error)
        return _fail(f"{shown(error.object)} is no text in UTF-8, wanted an argument that is", 2)
    except ValueError as error:
        if "null byte" not in str(error):
            return _unforeseen(error)
        return _fail("a file name holds a null byte: wanted a name without", 2)
    except (KeyboardInterrupt, click.Abort) as stop:
        return _fail(_interrupted(stop), 130)
    except OSError:  # of the output: a file's has its name by now
        raise
    except Exception as error:
        return _fail("interrupted", 130) if signals.came else _unforeseen(error)


def _interrupted(stop: BaseException) -> str:
    """Say that a command was stopped, and how it goes on where it said so."""
    first = stop.__cause__ if isinstance(stop, click.Abort) else stop
    return ": ".join(["interrupted", *(str(how) for how in getattr(first, "args", ()))])


def _missing(error: click.MissingParameter) -> str:
    """Say with a missing option what it is for, and where the examples are."""
    found = error.format_message().rstrip(".")
    if isinstance(error.param, click.Option) and error.param.help:
        found += f", wanted: {error.param.help.rstrip('.')}"
    path = error.ctx.command_path if error.ctx is not None else "mre-core"
    return f"{found} ({path} --help has examples)"


def _unforeseen(error: Exception) -> int:
    if os.environ.get(_DEBUG):
        raise error
    text = f"{type(error).__name__}: {error}"
    return _fail(f"please report this with its input: {text} ({_DEBUG}=1 shows where)", 1)


def _fail(message: str, status: int) -> int:
    _say(one_line(message))
    return status


def _say(text: str) -> None:
    try:
        print(f"mre-core: {text}", file=sys.stderr)
    except OSError:  # the disk that holds the errors may be the one that is full
        _give_up(sys.stderr)


def _give_up(stream: TextIO) -> None:
    """Send to nowhere what cannot be written: the interpreter tries it again as it ends, and fails for it."""
    with suppress(OSError), open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), stream.fileno())


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    _say(f"warning: {one_line(str(message))}")
