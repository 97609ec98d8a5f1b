"""The reliability diagram of P(lost): what the robot said against how often it was so."""
from evaluation import figures


def plot(path, curve, bound, subtitles):
    """`curve`: (mean P(lost), share lost) of each bin; `bound`: how far a bin may be off; two lines of text."""
    def fill(figure):
        axes = figure.subplots()
        axes.fill_between([0.0, 1.0], [-bound, 1.0 - bound], [bound, 1.0 + bound], color=figures.BLUE, alpha=0.12, linewidth=0.0,
                          label=f"bound: at most {bound:g} off")
        axes.plot([0.0, 1.0], [0.0, 1.0], color=figures.INK, linewidth=0.8, label="as often as it says")
        axes.plot(*zip(*curve), color=figures.BLUE, marker="o", markersize=4.5, clip_on=False, zorder=3, label="bin of the updates")
        axes.set(xlim=(0.0, 1.0), ylim=(0.0, 1.0), aspect="equal", xlabel="P(lost) as the robot says it, mean of the bin [1]",
                 ylabel="share of the updates that were lost [1]")
        axes.grid()
        axes.legend(loc="upper left")
        axes.set_title("\n".join(subtitles))
        figure.suptitle("Does the robot know when it is lost?", fontsize="large")

    figures.draw(path, (5.0, 5.4), fill)
