"""Crippled robots (architecture 10.17): they run by the same protocols and must fail them, by what they touch. One that only
stands idle fails floors, and shows nothing of what the protocol sees."""
from evaluation.reports import contacts_of, touches_of
from evaluation.tables import Verdict, print_table

CRIPPLED = {
    "blind to people": ["--set", "evaluation.blind_to_people=true"],
    "dead reckoning": ["--set", "evaluation.dead_reckoning=true"],
}
CRIPPLED_SEEDS = 3  # of the seeds of the whole robot
# Its eyes keep a robot that reckons dead off what they see: it may fail by being lost instead, while it drives.
MAY_BE_LOST = "dead reckoning"
LOST_SHARE, LOST_KM = 0.1, 0.1  # of the time; an hour
# The third way to cripple it, hazards from the best pose only, shows where the best pose is wrong: it is published so far
# off [m] in four directions while the belief is true, and visitors ask for what stands beside hazards.
BEST_POSE_OFF = [(0.0, 1.5), (1.5, 0.0), (0.0, -1.5), (-1.5, 0.0)]


def want_touches(how, where, reports, verdict):
    """@param how  a name of CRIPPLED"""
    km = sum(report["distance_m"] for report in reports) / 1000
    lost = sum(report["localization"]["lost_s"] for report in reports)
    seconds = sum(report["virtual_seconds"] for report in reports)
    is_lost = how == MAY_BE_LOST and km >= LOST_KM * seconds / 3600 and lost >= LOST_SHARE * seconds
    verdict.want(f"crippled, {how}, {where} (must touch{' or be lost' if how == MAY_BE_LOST else ''})",
                 f"{sum(map(contacts_of, reports))} contacts, {sum(report['area_violations'] for report in reports)} area "
                 f"violations in {km:.2f} km, {sum(report['passes_within_1m'] for report in reports)} passes within 1 m, lost for "
                 f"{lost:.0f} s", is_lost or sum(map(touches_of, reports)) > 0)


def hazards(simulations):
    """Beside what no sensor sees, with a best pose that is 1.5 m wrong: the whole belief must keep the robot clear, the
    best pose alone must not."""
    museum = simulations.museums / "bonn"
    scenario = simulations.root / "scripts" / "scenarios" / "beside-hazards.yaml"
    print("\n## bonn, quiet, best pose 1.5 m off while the belief is true, 12 minutes a direction\n")
    cells = [(name, best_only, x, y) for name, best_only in (("whole belief", "false"), ("best pose only", "true"))
             for x, y in BEST_POSE_OFF]
    reports = simulations.all([("hazards", museum, 1, 12, [
        "--crowd", "quiet", "--scenario", scenario, "--set", f"evaluation.best_pose_error_x={x}", "--set",
        f"evaluation.best_pose_error_y={y}", "--set", f"evaluation.best_pose_only={best_only}"]) for _, best_only, x, y in cells])
    print_table(["hazards from", "off by x, y m", "driven m", "hazards", "contacts", "area"],
                [[name, f"{x:+.1f}, {y:+.1f}", f"{report['distance_m']:.0f}", report["contacts"]["hazards"],
                  contacts_of(report), report["area_violations"]] for (name, _, x, y), report in zip(cells, reports)])
    verdict = Verdict()
    for name, must_fail in (("whole belief", False), ("best pose only", True)):
        some = [report for cell, report in zip(cells, reports) if cell[0] == name]
        touches, driven = sum(map(touches_of, some)), sum(report["distance_m"] for report in some)
        if must_fail:
            verdict.want(f"{name} (must touch)", f"{touches} in {driven:.0f} m", touches > 0)
        else:
            verdict.want(f"{name}: contacts and area violations", f"{touches} in {driven:.0f} m",
                         touches == 0 and driven >= 200)
    print()
    verdict.print()
    return verdict
