import numpy
import pytest

import docent


def test_beams_of_a_sweep():
    sweep = docent.RangeSweep()
    sweep.append(docent.LaserReading(numpy.array([1.0, 2.0, 99.0], numpy.float32), -0.5, 0.5, max_range=10.0), (0.5, 0.0, 0.0))
    beams = sweep.beams
    assert beams.dtype.names == ("bearing", "range", "no_return") and len(sweep) == 3
    assert beams["range"][1] == pytest.approx(2.5) and beams["bearing"][1] == pytest.approx(0.0)
    assert beams["no_return"].tolist() == [False, False, True]
    moved = docent.seen_from(sweep, (1.0, 0.0, 0.0))
    assert moved.beams["range"][1] == pytest.approx(3.5)


def readings(count=20000, sigma=0.1):
    """Of a sensor whose deviation is known, in a hall where a fifth of the beams ends on people."""
    random = numpy.random.default_rng(4)
    expected = random.uniform(1.0, 9.0, count)
    measured = expected + random.normal(0.0, sigma, count)
    short = random.random(count) < 0.2
    measured[short] = random.uniform(0.1, 1.0, short.sum()) * expected[short]
    return measured, expected


def test_a_fit_finds_the_sensor():
    counts = docent.ReadingCounts(10.0)
    assert counts.add(*readings()) == 20000 == counts.total()
    start = docent.ProximityModelParams(max_range=10.0, sigma=0.3)
    fit = docent.fit_proximity_model(counts, start)
    assert fit.readings == 20000 and fit.after > fit.before
    assert fit.after == pytest.approx(docent.mean_log_likelihood(counts, fit.params))
    assert (numpy.diff(fit.history) >= -1e-9).all() and not fit.history.flags.writeable
    assert 0.05 < fit.params.sigma < 0.15
    assert 0.05 < fit.params.weight_short + fit.params.weight_random < 0.4


def test_counts_pass_over_what_is_no_reading():
    counts = docent.ReadingCounts(10.0)
    nan, inf = numpy.nan, numpy.inf
    assert counts.add(numpy.array([1.0, nan, -1.0, inf, 3.0]), numpy.array([1.0, 1.0, 1.0, inf, nan])) == 2
    with pytest.raises(docent.Error, match="readings"):
        docent.fit_proximity_model(counts, docent.ProximityModelParams())
    with pytest.raises(ValueError, match="of one length"):
        counts.add(numpy.ones(3), numpy.ones(2))
    with pytest.raises(ValueError, match="max_range"):
        docent.fit_proximity_model(counts, docent.ProximityModelParams(max_range=5.0))
    with pytest.raises(ValueError, match="sigma"):
        docent.mean_log_likelihood(counts, docent.ProximityModelParams(sigma=-1.0))
    for most in [0.0, numpy.nan, numpy.inf]:
        with pytest.raises(ValueError, match="max_range"):
            docent.ReadingCounts(most)


def test_model():
    model = docent.ProximityModel()
    table = model.probabilities()
    assert table.shape == (docent.kRangeBins, docent.kExpectedRanges)
    assert table.sum(axis=0) == pytest.approx(numpy.ones(docent.kExpectedRanges), abs=1e-6)
    bin_of_4 = model.bin(4.0)
    assert model.lower_edge(bin_of_4) <= 4.0 < model.lower_edge(bin_of_4 + 1)
    assert model.probability(bin_of_4, bin_of_4) == table[bin_of_4, bin_of_4] > table[bin_of_4, model.bin(8.0)]
    assert model.centre(docent.kNoReturn) == 10.0
    for bad in [-1, docent.kRangeBins]:
        with pytest.raises(IndexError):
            model.probability(bad, 0)
    for bad in [-1.0, numpy.nan]:
        with pytest.raises(ValueError, match="range"):
            model.bin(bad)
