"""docs/pictures/adversarial.svg: what became of adversarial cuts by each method, as bars."""

from pages.facts.robustness import BROKEN, CROSS_CHECK

COLOURS = {"right": "#7fb3d5", "refused": "#d9d9d9", "wrong": "#b00020"}
ROW, LEFT, WIDTH = 17, 190, 460  # pixels


def shares(rows):
    """Of each outcome, of what was tried."""
    tried = rows["tried"].sum()
    right = rows[["ok", "noop", "deviated"]].sum().sum()
    return {"right": right / tried, "refused": rows["refused"].sum() / tried, "wrong": rows[BROKEN].sum().sum() / tried}


def bar(y, found):
    x, text = LEFT, ""
    for outcome, share in found.items():
        if share > 0:
            text += f'<rect x="{x:.1f}" y="{y}" width="{share * WIDTH:.1f}" height="{ROW - 4}" fill="{COLOURS[outcome]}"/>'
        x += share * WIDTH
    wrong = f"{100 * found['wrong']:.1f} % wrong" if found["wrong"] else "0 wrong"
    return text + f'<text x="{LEFT + WIDTH + 8}" y="{y + ROW - 7}">{wrong}</text>'


def of_outcomes(published):
    methods = [m for m in dict.fromkeys(published.robustness["method"]) if m != CROSS_CHECK] + [CROSS_CHECK]
    height = ROW * (len(methods) + 2)
    text = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {LEFT + WIDTH + 90} {height}" width="{LEFT + WIDTH + 90}" '
            'font-family="sans-serif" font-size="12"><title>Outcomes of adversarial cuts by method</title>'
            '<rect width="100%" height="100%" fill="white"/>\n')
    for k, method in enumerate(methods):
        name = "CGAL, whole sheet" if method == CROSS_CHECK else method
        text += f'<text x="{LEFT - 8}" y="{k * ROW + ROW - 5}" text-anchor="end">{name}</text>'
        text += bar(k * ROW + 2, shares(published.robustness[published.robustness["method"] == method])) + "\n"
    for k, (outcome, colour) in enumerate(COLOURS.items()):
        x = LEFT + 110 * k
        text += f'<rect x="{x}" y="{height - ROW}" width="12" height="12" fill="{colour}"/><text x="{x + 18}" y="{height - ROW + 11}">{outcome}</text>'
    return text + "\n</svg>\n"
