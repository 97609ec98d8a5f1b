"""What every protocol prints: tables, and bounds with what was seen."""


def print_table(header, rows):
    widths = [max(len(str(row[i])) for row in [header, *rows]) for i in range(len(header))]
    for k, row in enumerate([header, *rows]):
        print("| " + " | ".join(str(cell).rjust(width) for cell, width in zip(row, widths)) + " |")
        if k == 0:
            print("|" + "|".join("-" * (width + 2) for width in widths) + "|")


class Verdict:
    """Bounds, each printed with what was seen; every rate with its exposure."""

    def __init__(self):
        self.rows = []

    def want(self, what, seen, good):
        self.rows.append(("pass" if good else "FAIL", what, seen))

    def print(self):
        for result, what, seen in self.rows:
            print(f"{result}  {what}: {seen}")

    @property
    def good(self):
        return all(row[0] == "pass" for row in self.rows)
