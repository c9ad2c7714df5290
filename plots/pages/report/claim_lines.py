"""The paper's claims, a line each with its verdict; what was found is folded below it."""

from pages import claims
from pages.report.markup import badge, escape


def claim_rows(results):
    """{words of a claim: (verdict, evidence, whose run)}, of this machine's runs first."""
    rows = {}
    for folder, whose in ((results / "reference", "the project's own run"), (results, "run here")):
        try:
            text = (folder / "claims.md").read_text(encoding="utf-8")
        except OSError:
            continue
        for line in text.splitlines():
            cells = [c.strip() for c in line.strip("|").split(" | ")]
            if line.startswith("| ") and len(cells) >= 3 and cells[1].startswith("**"):
                rows[cells[0]] = cells[1].strip("*"), cells[2], whose
    return rows


def lines(results):
    """HTML: a <details> for each claim, with a link to the figures of its stem."""
    known, found = claim_rows(results), []
    for number, claim in enumerate(claims.CLAIMS, 1):
        command = f"experiments/reproduce {claim.stem}"
        verdict, evidence, whose = known.get(claim.words, ("untested", f"`{command}` makes the records", "not run"))
        found.append(f'<details id="claim-{number}"><summary>{escape(claim.words)} {badge(verdict)}</summary>'
                     f"<p>{escape(evidence)} <i>({whose})</i></p>"
                     f'<p><a href="#paper-{claim.stem}">Figures</a>. Command: <code>{escape(command)}</code></p></details>')
    return "".join(found)
