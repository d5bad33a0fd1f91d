"""Print the page: ``python -m licences`` in the folder of the tests."""

from .found import PAGE, page

PAGE.write_text(page(), encoding="utf-8")
