"""What each frame of a sheet cost that was cut while it swung, in numbers."""

import pandas as pd

from analysis import load

KEYS = ["method", "resolution"]


def read(folder):
    try:
        return pd.read_csv(folder / "frames.csv")
    except (OSError, ValueError) as error:
        load.stop(f"{folder / 'frames.csv'} can't be read: {error}; experiments/realtime makes it")


def row_of(frames, limits):
    """The numbers of one method at one resolution. The first step sets up the solver and is left out."""
    frames = frames.iloc[1:]
    total, cuts = frames["total_ms"], frames[frames["has_cut"] == 1]
    tenth = max(1, len(frames) // 10)
    refused = frames["cuts_refused"].iloc[0] if "cuts_refused" in frames else 0  # of older runs nobody knows
    row = {"verdict": frames["verdict"].iloc[0] + (f", {refused} cuts refused" if refused else ""), "frames": len(frames), "median": total.median(),
           "p99": total.quantile(0.99), "worst": total.max(), "cut median": cuts["total_ms"].median(),
           "cut worst": cuts["total_ms"].max(), "iterations": frames["iterations"].mean(),
           "growth": total.iloc[-tenth:].median() / total.iloc[:tenth].median()}
    for limit in limits:
        row[f"% in {limit:g} ms"] = 100 * (total <= limit).mean()
    row["99 % until, s"] = kept_until(frames, limits[0])
    return pd.Series(row)


def kept_until(frames, limit, share=0.99):
    """The longest time from the start in which this share of the frames takes at most `limit`."""
    kept = (frames["total_ms"] <= limit).expanding().mean() >= share
    return frames.loc[kept, "time_s"].max() if kept.any() else 0.0


def write_table(table, path, limit):
    lines = ["ms a frame, cuts included; growth: median of the last tenth of the frames over that of the first; "
             f"99 % until: the longest time from the start in which 99 % of the frames take at most {limit:g} ms",
             table.to_string(float_format=lambda value: f"{value:.3g}")]
    part = path.with_suffix(".part")
    part.write_text("\n".join(lines) + "\n", encoding="utf-8")
    part.replace(path)
    print("\n".join(lines))
