"""What the checks of this folder count and tell."""

checks = 0
faults = []


def check(condition, fault):
    global checks
    checks += 1
    if not condition:
        faults.append(fault)


def report():
    """Prints every fault and the counts; the exit code."""
    for fault in faults:
        print(fault)
    print(f"{checks - len(faults)} passed, {len(faults)} failed")
    return 1 if faults else 0
