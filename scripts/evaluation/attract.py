"""Learning to attract people [Minerva2000] 6.3: the learner before crowds whose taste it does not know.

One run is `docent-lab attract --seed N`: 201 phases of a minute, as many as Minerva had. The crowd likes a friendly robot, or an
upset one, or does not care; the same seeds for each. A claim is what the robot says of its styles when it is more than chance.
How much the crowd likes it is our own choice, because the paper prints no number: weaker likings are shown beside it.
"""
import concurrent.futures
import hashlib
import json
import os
import subprocess

from evaluation.tables import Verdict, print_table

SEEDS, TRIALS = 20, 201
MORE, FEWER, NONE = "friendly attracts more", "friendly attracts fewer", "none"
RIGHT = {"friendly": MORE, "upset": FEWER, "neither": NONE}
FOUND, FALSE = 18, 1  # of 20 seeds
MANY_SEEDS, FALSE_SHARE = 200, 0.05  # without a taste; the learner's own promise
WEAKER = [0.4, 0.7, 1.0]  # likings that are shown
FRIENDLY_AT_END = 0.7  # share of what the learner knows best in the last third of its phases
CRIPPLED = {"never explores": ["--set", "evaluation.never_explores=true"],
            "ignores the reward": ["--set", "evaluation.ignores_reward=true"]}
HEADER = ["crowd likes it", "liking", "learner", "runs", "claims more", "claims fewer", "after (median)", "friendly - upset, sd",
          "friendly at end %", "reward at end"]


class Bench:
    def __init__(self, program, cache, run_key, jobs):
        self.program, self.cache, self.key, self.jobs = program, cache / "attract", run_key, jobs
        self.cache.mkdir(parents=True, exist_ok=True)

    def run(self, seed, taste, arguments):
        key = hashlib.sha256(json.dumps([self.key, seed, taste, TRIALS, arguments]).encode()).hexdigest()[:16]
        path = self.cache / f"{taste}-seed{seed}-{key}.json"
        if not path.exists():
            part = path.with_suffix(f".part{os.getpid()}-{seed}")
            done = subprocess.run([self.program, "attract", "--seed", str(seed), "--taste", taste, "--trials", str(TRIALS),
                                   "--report", part, "--quiet", *arguments], capture_output=True, text=True, check=False)
            if done.returncode != 0 or not part.exists():
                raise RuntimeError(f"seed {seed}: docent-lab attract exited {done.returncode}: {done.stderr.strip()[-400:]}")
            part.rename(path)
        return json.loads(path.read_text())

    def all(self, seeds, taste, arguments=()):
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(lambda seed: self.run(seed, taste, list(arguments)), seeds))


def claims(reports, claim):
    return sum(report["claim"] == claim for report in reports)


def mean(reports, key):
    return sum(report[key] for report in reports) / len(reports)


def row_of(learner, reports):
    after = sorted(report["claimed_after"] for report in reports if report["claimed_after"])
    return [reports[0]["taste"], f"{reports[0]['liking']:.1f}", learner, len(reports), claims(reports, MORE), claims(reports, FEWER),
            after[len(after) // 2] if after else "-", f"{mean(reports, 'difference'):+.2f}",
            f"{100 * mean(reports, 'friendly_at_end'):.0f}", f"{mean(reports, 'last_reward'):.2f}"]


def fails(reports, taste):
    """Whether a learner misses what the whole one must reach."""
    return claims(reports, RIGHT[taste]) < FOUND / SEEDS * len(reports)


def judge(found, crippled, without_taste):
    """`found`: reports by the crowd's taste; `crippled`: by name, of the crowd that likes it friendly; `without_taste`: many."""
    verdict = Verdict()
    for taste in ("friendly", "upset"):
        some = found[taste]
        right = claims(some, RIGHT[taste])
        verdict.want(f"people like it {taste}: finds it within {TRIALS} phases in {FOUND} of {SEEDS}", f"{right} of {len(some)}",
                     not fails(some, taste))
        wrong = len(some) - right - claims(some, NONE)
        verdict.want(f"people like it {taste}: claims the contrary", f"{wrong} of {len(some)}", wrong == 0)
    friendly, upset = mean(found["friendly"], "friendly_at_end"), mean(found["upset"], "friendly_at_end")
    verdict.want("what it knows best at the end is friendly where people like that, and is not where they like it upset",
                 f"{100 * friendly:.0f} % and {100 * upset:.0f} %", friendly >= FRIENDLY_AT_END and upset <= 1 - FRIENDLY_AT_END)
    false = len(found["neither"]) - claims(found["neither"], NONE)
    verdict.want(f"people do not care: false claims in at most {FALSE} of {SEEDS}", f"{false} of {len(found['neither'])}",
                 false <= FALSE / SEEDS * len(found["neither"]))
    if without_taste:
        false = len(without_taste) - claims(without_taste, NONE)
        verdict.want(f"people do not care, many seeds: false claims in at most {100 * FALSE_SHARE:.0f} %",
                     f"{false} of {len(without_taste)}", false <= FALSE_SHARE * len(without_taste))
    for name, reports in crippled.items():
        verdict.want(f"crippled, {name} (must not find it)", f"{claims(reports, MORE)} of {len(reports)}", fails(reports, "friendly"))
    phases = sum(report["phases"] for reports in found.values() for report in reports)
    runs = sum(map(len, found.values()))
    verdict.want("phases that were remembered", f"{phases} in {runs} runs", phases >= 0.99 * TRIALS * runs)
    verdict.want_one_configuration(report["config_hash"] for reports in found.values() for report in reports)
    return verdict


def protocol(bench, options):
    count = options.seeds or SEEDS
    seeds = range(options.first_seed, options.first_seed + count)
    print(f"\n## attracting people, {TRIALS} phases of a minute, {count} seeds a crowd\n")
    found = {taste: bench.all(seeds, taste) for taste in RIGHT}
    rows = [row_of("whole", reports) for reports in found.values()]
    without_taste = []
    if not options.slice:
        without_taste = bench.all(range(1001, 1001 + MANY_SEEDS), "neither")
        rows.append(row_of("whole, other seeds", without_taste))
        rows += [row_of("whole, weaker taste", bench.all(seeds, "friendly", ["--liking", str(liking)])) for liking in WEAKER]
    crippled = {} if options.no_crippled else {name: bench.all(seeds, "friendly", arguments) for name, arguments in CRIPPLED.items()}
    rows += [row_of(name, reports) for name, reports in crippled.items()]
    print_table(HEADER, rows)
    print("\nfriendly - upset: difference of the mean rewards of what was done, in standard deviations of its crowd; friendly at end: of "
          "what the learner knows best in the last third of its phases; reward at end: mean of these phases. The crowd is our own model")
    verdict = judge(found, crippled, without_taste)
    print("\n## bounds\n")
    verdict.print()
    return verdict
