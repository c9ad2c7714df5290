"""What can go wrong, as exceptions. Each has the program's own line: what is wrong, where, and what to do."""

import re


def as_keywords(text):
    """The program's words, with keywords of functions in place of its options."""
    text = text.replace("`cutbench methods` lists them", "cutbench.methods() lists them")
    text = re.sub(r"--rest (auto|vt|plane|space)\b", r'rest="\1"', text)
    text = re.sub(r"--sew ([\d.]+)", r"sew=\1", text)
    text = re.sub(r"--(allow-miss|triangulate)\b", lambda found: found[1].replace("-", "_") + "=True", text)
    return re.sub(r"--([a-z]+(-[a-z]+)*)", lambda found: found[1].replace("-", "_"), text)


class InputError(ValueError):
    """An argument or a file that can't be used."""

    def __init__(self, message):
        super().__init__(as_keywords(message))


class OutputError(OSError):
    """A file that can't be written."""


class CutError(RuntimeError):
    """A cut that was not made; the sheet is as it was.

    Attributes:
        status: "refused" (known before the cut) or "failed".
        verdict: of a failure, such as "inverted" or "crashed" (results/README.md, column `verdict`).
    """

    def __init__(self, message, status="failed", verdict="failed"):
        super().__init__(message)
        self.status, self.verdict = status, verdict


class Refused(CutError):
    """To be raised by a method of one's own: it can't make this cut, and says why in one line."""

    def __init__(self, message):
        super().__init__(message, "refused", "refused")


class StepError(RuntimeError):
    """A step that ended a simulation.

    Attributes:
        verdict: such as "solver_stalled" (results/README.md, column `verdict`).
    """

    def __init__(self, message, verdict):
        super().__init__(message)
        self.verdict = verdict


class RunError(RuntimeError):
    """A run in a process of its own that ended without a result."""
