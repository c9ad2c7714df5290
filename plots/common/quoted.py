"""Numbers that the pages quote, a line each, for plots/quoted_*.py."""

from common import load


def say(words, *values):
    print(f"  {words}: {', '.join(value if isinstance(value, str) else load.number(float(value)) for value in values)}")


def span(values, digits=3):
    values = [float(value) for value in values]
    return f"{load.number(min(values), digits)} to {load.number(max(values), digits)}"
