#!/usr/bin/env python3
"""What Doxygen reads of a file: doc_filter.py FILE. What means the same in every type has its comment here, once, and not in each
header. Lines stay where they are, so that a fault names the line of the header."""
import re
import sys
from pathlib import Path

SAME = [
    (r"template <class V>\n\s*void visit\(V& v\)", "Calls v(name, field) for every field that robot.yaml may set, in order."),
    (r"template <class Self, class V>\n\s*static void visit\(Self& m, V& v\)",
     "Calls v(name, field) for every field, in the order of the wire."),
    (r"\[\[nodiscard\]\] Result<void> validate\(\) const;", "Error: names the first field that is out of its bounds, and the bound."),
    (r"static constexpr const char\* kType =", "Name of the type in ROS 2."),
    (r"friend bool operator==\(.*\) = default;", "All members are equal."),
    (r"\w+\(\w+&&( other)?\) noexcept", "Takes over what the other one holds."),
    (r"\w+& operator=\(\w+&&( other)?\) noexcept", "Takes over what the other one holds."),
]
# Types that ROS 2 defines have its fields; what they mean is said there.
OF_ROS = "standard_messages.h"
FIELD = r"^  (?!static|using|friend|return|.*(?:///|\(|\}$))[^/]*;$"
# Several members in one declaration: Doxygen gives the comment to one of them alone.
TOGETHER = re.compile(r"^( +)((?:std::)?\w+) (\w+ = [\w.]+|\w+)((?:, \w+(?: = [\w.]+)?)+);(?: +///< (.*))?$", re.M)


def apart(match):
    indent, kind, first, others, comment = match.groups()
    comment = f" ///< {comment}" if comment else ""
    return indent + " ".join(f"{kind} {name};" + (f" /**< {comment[6:]} */" if comment else "")
                             for name in [first, *others[2:].split(", ")])


def filtered(text, name):
    if name.endswith(".md"):  # links between files of the source tree stay words
        return re.sub(r"\[([^\]]+)\]\((?!https?:)[^)]*\)", r"\1", text)
    for pattern, comment in SAME:
        text = re.sub(rf"^([ ]*)({pattern})", rf"\1/** {comment} */ \2", text, flags=re.M)
    text = re.sub(r"^inline constexpr Topic<([\w:]+)> (\w+)", r"/** Carries \1. */ \g<0>", text, flags=re.M)
    text = re.sub(r"\b(eq|Fig)\. (?=\d)", r"\1.\\ ", text)  # else the brief ends there
    text = TOGETHER.sub(apart, text)
    if name == OF_ROS:
        text = re.sub(FIELD, lambda line: re.sub(r" *([^;]+;)", r"  /** As in ROS 2. */ \1", line[0]), text, flags=re.M)
        text = re.sub(r"^struct ", "/** The type of ROS 2 of this name, field for field. */ struct ", text, flags=re.M)
    return text


if __name__ == "__main__":
    path = Path(sys.argv[1])
    sys.stdout.write(filtered(path.read_text(), path.name))
