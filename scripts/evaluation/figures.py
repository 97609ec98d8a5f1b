"""Figures of the protocols, by matplotlib, as SVG. The same data make the same file."""
import os

WIDTH = 7.2  # [inch] of a page's text
STYLE = {
    "font.family": "DejaVu Sans", "font.size": 8.5, "axes.titlesize": 9.0, "axes.linewidth": 0.7, "axes.axisbelow": True,
    "axes.edgecolor": "#262a38", "grid.color": "#dddddd", "grid.linewidth": 0.6, "lines.linewidth": 1.2,
    "legend.frameon": False, "legend.fontsize": 8.0, "xtick.labelsize": 7.5, "ytick.labelsize": 7.5,
    "svg.hashsalt": "docent",  # names inside the file, else drawn anew each time
}
BLUE, LIGHT_BLUE, ORANGE, RED, INK = "#2662b4", "#9bb7dd", "#e9841c", "#ce302c", "#262a38"

DASHED = (0, (4, 3))  # [line widths] line and gap
HEAD = 0.55  # [inch] title and legend above the panels


def under_legend(figure):
    """The part for the panels; `legend` fills the other."""
    height = figure.get_size_inches()[1]
    return figure.subfigures(2, 1, height_ratios=[HEAD, height - HEAD])[1]


def legend(figure, title, samples):
    figure.subfigs[0].suptitle(title, fontsize="large")
    figure.subfigs[0].legend(handles=samples, loc="lower center", ncols=len(samples))


def draw(path, size, fill):
    """`fill` draws on a figure of `size` [inch]; then it is written to the path, whole or not at all."""
    import matplotlib  # where a protocol draws, not where the program begins: it is installed only then

    with matplotlib.rc_context({**matplotlib.rcParamsDefault, **STYLE}):
        from matplotlib.figure import Figure

        figure = Figure(figsize=size, layout="constrained")
        fill(figure)
        beside = path.with_suffix(f".part{os.getpid()}")
        figure.savefig(beside, format="svg", metadata={"Date": None})
    beside.rename(path)
