"""From the bytes of a text file to its characters."""

import codecs
import re
from typing import Final

from ..errors import InputError

_BOMS: Final = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_RUNS: Final = re.compile(rb"[\x80-\xff]+")
_SAMPLE: Final = 65536


def decode(data: bytes, file: str, encoding: str | None = None) -> tuple[str, str]:
    """Decode a text file.

    UTF-8 is tried first. What is not UTF-8 is GBK where all foreign bytes come in pairs and some pairs in
    a row, as words of Chinese do; else cp1252, where they stand single between letters. A detector by
    letter statistics takes the degree sign of a lone ``[°C]`` for Chinese.

    Parameters
    ----------
    data : bytes
        The file.
    file : str
        Its name.
    encoding : str, optional
        Encoding given by the user.

    Returns
    -------
    (text, encoding) : tuple of str
        Characters, and the encoding used.

    Raises
    ------
    InputError
        It is no text, or not of the encoding given.
    """
    used = encoding or _find(data, file)
    try:
        return data.decode(used).removeprefix("\ufeff"), used
    except UnicodeDecodeError as error:
        # The position counts from behind a byte-order mark.
        line = error.object.count(b"\n", 0, error.start) + 1
        found = f"byte 0x{error.object[error.start]:02x} is not {used}"
        wanted = f"text in {used}, or another encoding, as read encoding=cp1252"
        raise InputError(found, file=file, line=line, wanted=wanted) from None
    except (UnicodeError, LookupError):
        raise InputError(f"is no {used} text", file=file, wanted="another encoding") from None


def _find(data: bytes, file: str) -> str:
    for mark, name in _BOMS:
        if data.startswith(mark):
            return name
    if b"\0" in data:
        return _without_mark(data, file)
    if _is(data, "utf-8"):
        return "utf-8"
    runs = [len(match) for match in _RUNS.findall(data)]
    paired = all(length % 2 == 0 for length in runs) and max(runs) >= 4
    if paired and _is(data, "gb18030"):
        return "gb18030"
    # Five codes of cp1252 stand for nothing.
    return "cp1252" if _is(data, "cp1252") else "latin-1"


def _without_mark(data: bytes, file: str) -> str:
    """UTF-16 without a byte-order mark has a null byte in every letter; a binary file has them anywhere."""
    sample = data[: _SAMPLE - _SAMPLE % 2]
    for name, high, low in (("utf-16-le", 1, 0), ("utf-16-be", 0, 1)):
        if len(data) % 2 == 0 and not any(sample[low::2].count(bytes([code])) for code in range(9)):
            if sample[high::2].count(0) > 0.5 * len(sample) / 2 and _is(data, name):
                return name
    raise InputError("is not a text file", file=file, wanted="text, or a file with the ending of its format")


def _is(data: bytes, encoding: str) -> bool:
    try:
        data.decode(encoding)
    except UnicodeError:
        return False
    return True
