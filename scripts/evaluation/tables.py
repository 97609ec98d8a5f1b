"""What every protocol prints: tables, and bounds with what was seen."""


def print_table(header, rows):
    widths = [max(len(str(row[i])) for row in [header, *rows]) for i in range(len(header))]
    for k, row in enumerate([header, *rows]):
        print("| " + " | ".join(str(cell).rjust(width) for cell, width in zip(row, widths)) + " |")
        if k == 0:
            print("|" + "|".join("-" * (width + 2) for width in widths) + "|")


class Verdict:
    """Bounds, each printed with what was seen; every rate with its exposure. And the configurations that they are of."""

    def __init__(self):
        self.rows = []
        self.hashes = set()

    def want(self, what, seen, good):
        self.rows.append(("pass" if good else "FAIL", what, seen))

    def note(self, what, seen):
        """Shown, not judged."""
        self.rows.append(("    ", what, seen))

    def want_one_configuration(self, hashes, of=""):
        """`of`: a part of the protocol whose configuration is one of its own."""
        hashes = set(hashes)
        self.hashes |= hashes
        self.want(f"one configuration{of and ', ' + of}", ", ".join(sorted(hashes)) or "none", len(hashes) == 1)

    def add(self, other):
        self.rows += other.rows
        self.hashes |= other.hashes

    def print(self):
        for result, what, seen in self.rows:
            print(f"{result}  {what}: {seen}")

    @property
    def good(self):
        return bool(self.rows) and all(row[0] != "FAIL" for row in self.rows)
