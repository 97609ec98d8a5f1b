"""What the library could not do."""
from __future__ import annotations

import re


class Error(Exception):
    """Why something could not be done, in one line. Faults of a file begin with "FILE:LINE: " or "FILE: ".

    file: the file, or None; the path opens it, whatever bytes it is made of. line: the line in it, counted from 1, or None.
    """

    file: str | None
    line: int | None

    def __init__(self, message: str):
        # what is not UTF-8 came as surrogates, which cannot be printed
        super().__init__(re.sub("[\ud800-\udfff]", "\ufffd", message))
        place = re.match(r"(?P<file>[^:\n]*[^:\s\d][^:\n]*):(?:(?P<line>\d+):)? ", message)
        self.file = place["file"] if place else None
        self.line = int(place["line"]) if place and place["line"] else None


Error.__module__ = "docent"
