"""Rows as a pandas.DataFrame where pandas is there; else as they are, a list of dicts."""


def table(rows, index=None):
    try:
        import pandas
    except ImportError:
        return rows
    frame = pandas.DataFrame(rows)
    return frame.set_index(index) if index else frame
