"""The belief over 320 million states; and Bonn, busy, on one core with the plain instruction set: what `localize` needs of the
time that passes."""
import json
import os
import subprocess

from evaluation.tables import Verdict

TARGET = "docent_localization_markov_benchmark"


def want_large_belief(simulations, verdict):
    if not os.environ.get("DOCENT_BINARY"):
        subprocess.run(["cmake", "--build", "--preset", "dev", "--target", TARGET], cwd=simulations.root, check=True,
                       stdout=subprocess.DEVNULL)
    simulations.cache.mkdir(parents=True, exist_ok=True)
    done = subprocess.run([simulations.root / "build/dev/src/docent/localization/markov" / TARGET, "--benchmark_filter=large_map"],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False,
                          env=dict(os.environ, DOCENT_LARGE_MAP="1", DOCENT_CACHE=str(simulations.cache)))
    print(done.stdout)
    verdict.want("200 x 200 m", "the table above", done.returncode == 0 and "FAIL" not in done.stdout
                 and "peak memory" in done.stdout)


def protocol(simulations, options):
    verdict = Verdict()
    if not options.slice:
        want_large_belief(simulations, verdict)
    minutes = 2 if options.slice else 10
    path = simulations.cache / "plain.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(["taskset", "-c", "0", simulations.docent, "simulate", "--museum", simulations.museums / "bonn", "--crowd",
                           "busy", "--hours", f"{minutes / 60:.6f}", "--seed", "1", "--profile", "--quiet", "--set",
                           "localize.simd=plain", "--report", path], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"docent simulate exited {done.returncode}: {done.stderr.strip()[-500:]}")
    print(done.stdout)
    report = json.loads(path.read_text())
    spent = {line.split()[0]: float(line.split()[1]) for line in done.stdout.splitlines() if line.startswith("localize")}
    verdict.want("simd of the report (plain)", report["simd"], report["simd"] == "plain")
    verdict.want("localize, share of the time that passes (0.5)", f"{sum(spent.values()) / 1000:.3f}", 0 < sum(spent.values()) < 500)
    verdict.want("lost for", f"{report['localization']['lost_s']:.1f} s", report["localization"]["lost_s"] < 0.01 * 60 * minutes)
    verdict.print()
    return verdict
