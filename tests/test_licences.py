"""Nothing in the wheel binds who uses it, and the list of what is in it is current."""

import shutil

import pytest
from licences.found import PAGE, crates, packages, permissive


@pytest.fixture(scope="module")
def linked() -> dict[str, tuple[str, str]]:
    if shutil.which("cargo") is None:
        pytest.skip("no cargo, which knows the licences of the crates")
    return crates()


def test_no_copyleft_in_the_wheel(linked: dict[str, tuple[str, str]]) -> None:
    assert len(linked) > 10
    assert [name for name, (_, licence) in linked.items() if not permissive(licence)] == []


def test_the_list_is_current(linked: dict[str, tuple[str, str]]) -> None:
    listed = PAGE.read_text(encoding="utf-8")
    for name, (_, licence) in linked.items():
        assert f"| {name} | {licence} |" in listed
    assert listed.count("\n| ") == len(linked) + len(packages()) + 2


@pytest.mark.parametrize(
    ("expression", "free"),
    [
        ("MIT", True),
        ("GPL-3.0-only", False),
        ("MIT OR Apache-2.0 OR LGPL-2.1-or-later", True),
        ("(MIT OR Apache-2.0) AND Unicode-3.0", True),
        ("MIT AND MPL-2.0", False),
        ("MIT/Apache-2.0", True),
        ("not stated", False),
    ],
)
def test_copyleft_is_seen(expression: str, free: bool) -> None:
    assert permissive(expression) is free
