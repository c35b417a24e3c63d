#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether budgets.py notices what it is there to notice, on the figures of the page itself."""
import contextlib
import io
import sys

import budgets

PAGE = budgets.PAGE.read_text()


def wrong(figures, budget):
    """How many figures it complains of, and all that it says."""
    with contextlib.redirect_stdout(io.StringIO()) as said:
        found = budgets.compare(figures, budget)
    return len(found), said.getvalue() + "\n".join(found)


def refused(page):
    """Whether the page is refused as it stands."""
    try:
        budgets.committed_in(page)
    except SystemExit:
        return True
    return False


def noticed_worse(key, figures, budget):
    """Whether it complains, with both figures, of one that is a little more than 3 % worse."""
    worse = int(figures[key] * 1.03) + 1
    count, said = wrong(figures | {key: worse}, budget)
    return count == 1 and f"{worse:,} measured, {figures[key]:,} on the page" in said


def check(good, what):
    if not good:
        sys.exit(f"not noticed: {what}")
    print(f"noticed: {what}")


def main():
    budget, version = budgets.committed_in(PAGE)
    figures = {key: value for key, (value, _) in budget.items()}
    check(budgets.written(figures, version) == PAGE, "the page is what --write makes of its figures")
    check(len(figures) > 150 and wrong(figures, budget)[0] == 0, "a budget that is kept")
    unnoticed = [key for key in figures if not noticed_worse(key, figures, budget)]
    check(not unnoticed, f"each of {len(figures)} figures 3 % worse, with both, but {len(unnoticed)}: {unnoticed[:3]}")
    unnoticed = [key for key in figures if wrong({k: v for k, v in figures.items() if k != key}, budget)[0] != 1]
    check(not unnoticed, f"each of {len(figures)} figures missing, but {len(unnoticed)}: {unnoticed[:3]}")
    key = "stages", "cortex-m0", "pipeline_waypoint"
    check(wrong(figures | {key: int(figures[key] * 1.029)}, budget)[0] == 0, "2.9 % worse is no failure")
    count, said = wrong(figures | {key: figures[key] // 2}, budget)
    check(count == 0 and "better: whole pipeline, a waypoint, Cortex-M0" in said, "what is better, without a failure")
    check(wrong(figures | {key: None}, budget)[0] == 0, "what cannot be measured here is no failure")
    check(wrong(figures, {k: v for k, v in budget.items() if k != key})[0] == 1, "a figure that is not on the page")
    check(refused(PAGE.replace("| whole pipeline, a waypoint |", "| a waypoint |")), "a row with another label")
    check(refused(PAGE.replace("Cortex-M4F", "Cortex-M4", 1)), "a text that the template does not have")
    check(refused(PAGE + "more\n"), "a line too many")


if __name__ == "__main__":
    main()
