"""The numbers, tables and conclusions of README.md and docs/, each a named function of the published records."""

from pages.facts import choices, comparison, decision, motion, paper, remedies, robustness, solvers, stability, tips, whole_step  # noqa: F401
