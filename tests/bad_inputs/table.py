"""The table: kinds of bad input by the place where they come in."""

from collections.abc import Mapping

from .arrays import ARRAYS
from .calls import CALLED
from .campaigns import CAMPAIGNS
from .configs import CONFIGS
from .files import FILES
from .frames import FRAMES
from .halves import HALVES
from .jobs import JOBS
from .loading import LOADING
from .made import Call, Command
from .models import MODELS
from .options import OPTIONS
from .places import PLACES
from .strangers import STRANGERS
from .trials import TRIALS

GROUPS: Mapping[str, Mapping[str, Command | Call]] = {
    "Recordings, `mre-core identify`": FILES,
    "Text files, `mre_core.load`": LOADING,
    "Arrays, `mre_core.Recording`": ARRAYS,
    "Data frames, `mre_core.from_dataframe`": FRAMES,
    "Options, `mre-core identify`": OPTIONS,
    "Settings files, `--config`": CONFIGS,
    "Model files": MODELS,
    "Model files that were tampered with": STRANGERS,
    "Other commands": CAMPAIGNS,
    "Trials of others": TRIALS,
    "Places to write to": PLACES,
    "Functions of Python": CALLED,
    "Long work from Python": JOBS,
    "Texts with half of a character": HALVES,
}

ROWS = {f"{kind} ({title})": row for title, rows in GROUPS.items() for kind, row in rows.items()}
COMMANDS = {kind: row for kind, row in ROWS.items() if isinstance(row, Command)}
CALLS = {kind: row for kind, row in ROWS.items() if isinstance(row, Call)}
