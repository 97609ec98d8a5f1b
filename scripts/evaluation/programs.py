"""The two programs of the protocols: `docent`, which is measured, and `docent-lab` beside it, which measures and cripples."""
from pathlib import Path

LABORATORY = "docent-lab"


def laboratory(docent):
    """The laboratory that was built with `docent`: it lies in the same folder."""
    path = Path(docent).parent / LABORATORY
    if not path.is_file():
        raise RuntimeError(f"{path} is missing: what measures and cripples a robot is the program {LABORATORY}, "
                           f"which is built beside docent (cmake --build --preset dev --target {LABORATORY})")
    return path


def program_for(docent, arguments):
    """The program of a run with these arguments: a robot that section `evaluation` cripples is made by the laboratory alone."""
    return laboratory(docent) if any(str(argument).startswith("evaluation.") for argument in arguments) else docent


def programs_of(docent):
    """Those that decide what runs give, for keys; the laboratory where it is built."""
    return [path for path in (Path(docent), Path(docent).parent / LABORATORY) if path.is_file()]
