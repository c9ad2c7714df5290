"""Pieces of HTML that all parts of the report share."""

import base64
import html
import io

from PIL import Image

from analysis import load

WIDEST = 1400  # pixels: the page is to stay below 6 MB


def escape(text):
    """Text with `commands` and **stress**, as HTML."""
    parts = html.escape(text).split("`")
    text = "".join(f"<code>{p}</code>" if i % 2 else p for i, p in enumerate(parts))
    parts = text.split("**")
    return "".join(f"<b>{p}</b>" if i % 2 else p for i, p in enumerate(parts))


def badge(verdict):
    kind = {"held": "held", "not held": "not", "failed": "not", "ran to the end": "untested", "untested": "untested", "not run": "untested"}.get(verdict, "cond")
    word, _, condition = verdict.partition(": ")
    return f'<span class="{kind}">{escape(word)}</span>{" " + escape(condition) if condition else ""}'


def table_of(columns, rows):
    def cell(tag, value):
        number = not isinstance(value, str)
        return f'<{tag}{" class=n" if number else ""}>{escape(load.number(value) if number else value)}</{tag}>'
    head = "".join(cell("th", c) for c in columns)
    body = "".join(f"<tr>{''.join(cell('td', c) for c in row)}</tr>" for row in rows)
    return f'<div class="wide"><table><tr>{head}</tr>{body}</table></div>'


def picture_of(results, stem, name):
    """(file, whether it is one of the project's own runs), or None."""
    for file, reference in ((results / stem / f"{name}.png", False), (results / f"{name}.png", False),
                            (results / "reference" / f"{name}.png", True)):
        if file.is_file():
            return file, reference
    return None


def inlined(file):
    """A data URI: stills as WebP, the smaller of 64 colours without loss and all colours with some; animations as they are."""
    data = file.read_bytes()
    if file.suffix == ".png":
        picture = Image.open(file).convert("RGB")
        if picture.width > WIDEST:
            picture = picture.resize((WIDEST, picture.height * WIDEST // picture.width), Image.Resampling.LANCZOS)
        few = picture.quantize(64, dither=Image.Dither.NONE).convert("RGB")
        data = min(as_webp(few, lossless=True, quality=30), as_webp(picture, quality=70), key=len)
    return "data:image/webp;base64," + base64.b64encode(data).decode("ascii")


def as_webp(picture, **options):
    buffer = io.BytesIO()
    picture.save(buffer, "WEBP", method=4, **options)
    return buffer.getvalue()


def figure_of(file, note):
    with Image.open(file) as image:
        width, height = image.size
    whole = file.with_suffix(".caption.txt")
    caption = f": {whole.read_text(encoding='utf-8').strip()}" if whole.is_file() else ""
    words = html.escape(" ".join((file.stem + caption).split()))
    return (f'<figure><img src="{inlined(file)}" width="{width}" height="{height}" alt="{words}">'
            f"<figcaption>{escape(file.stem + note + caption)}</figcaption></figure>")
