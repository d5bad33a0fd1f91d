"""Print the page: ``python -m bad_inputs`` in the folder of the tests."""

from .page import PAGE, page
from .run import everything_said

PAGE.write_text(page(everything_said()), encoding="utf-8")
