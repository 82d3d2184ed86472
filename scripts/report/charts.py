# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Charts as inline SVG, whose colours come from the page's style sheet so that they follow its light or dark theme."""

import html
import math

FONT_PX = 12.5
CHARACTER_PX = 0.56 * FONT_PX  # mean width, for laying out labels


def escape(text):
    return html.escape(str(text), quote=True)


def text_width(text):
    return len(str(text)) * CHARACTER_PX


def series_class(name):
    """The style sheet's class of a method: its colour."""
    known = {"forest", "forest+icp", "forest+icp+rank", "ferns", "paper"}
    return "s-" + (name.replace("+", "-") if name in known else "other")


def format_tick(value):
    if value >= 10000:
        return f"{value / 1000:.3g}k"
    return f"{value:g}"


def percent_tick(value):
    """Percent; the unit stands at the top only."""
    return f"{value:g} %" if value == 100 else f"{value:g}"


def nice_ticks(low, high, most=5):
    """Round numbers that cover [low, high]."""
    step = 10 ** math.floor(math.log10(max(high - low, 1e-12) / most))
    for factor in (1, 2, 5, 10):
        if (high - low) / (factor * step) <= most:
            step *= factor
            break
    first = math.ceil(low / step - 1e-9)
    return [round(i * step, 12) for i in range(first, math.floor(high / step + 1e-9) + 1)]


class Axis:
    """Maps values to pixels, linearly or by their logarithm."""

    def __init__(self, low, high, log=False):
        self.low, self.high, self.log = low, high if high > low else low + 1, log

    def part(self, value):
        if self.log:
            return math.log(max(value, 1e-12) / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)

    def ticks(self):
        return nice_ticks(self.low, self.high)


class Chart:
    """A plot with axes. Sizes are those at which text is shown 1:1; the page scales charts down only a little."""

    def __init__(self, x, y, width=360, height=230, left=46, right=14, top=12, bottom=40, label=""):
        self.x, self.y, self.width, self.height = x, y, width, height
        self.left, self.right, self.top, self.bottom = left, right, top, bottom
        self.label = label
        self.parts = []
        self.end_labels = []

    def px(self, value):
        return self.left + self.x.part(value) * (self.width - self.left - self.right)

    def py(self, value):
        return self.height - self.bottom - self.y.part(value) * (self.height - self.top - self.bottom)

    def add(self, part):
        self.parts.append(part)

    def text(self, x, y, words, anchor="middle", style="tick"):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" class="{style}">{escape(words)}</text>')

    def draw_axes(self, x_ticks=None, y_ticks=None, x_title="", y_format=format_tick, x_format=format_tick):
        bottom = self.height - self.bottom
        for value in self.y.ticks() if y_ticks is None else y_ticks:
            y = self.py(value)
            self.add(f'<line x1="{self.left}" x2="{self.width - self.right}" y1="{y:.1f}" y2="{y:.1f}" class="grid"/>')
            self.text(self.left - 7, y + 4, y_format(value), "end")
        last_end = -1e9
        for value in self.x.ticks() if x_ticks is None else x_ticks:
            x, words = self.px(value), x_format(value)
            self.add(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{bottom}" y2="{bottom + 4}" class="axis"/>')
            if x - text_width(words) / 2 > last_end + 3:
                self.text(x, bottom + 17, words)
                last_end = x + text_width(words) / 2
        self.add(f'<line x1="{self.left}" x2="{self.width - self.right}" y1="{bottom}" y2="{bottom}" class="axis"/>')
        if x_title:
            self.text((self.left + self.width - self.right) / 2, self.height - 5, x_title, style="title")

    def line(self, points, style):
        path = " ".join(f"{self.px(x):.1f},{self.py(y):.1f}" for x, y in points)
        self.add(f'<polyline points="{path}" class="line {style}"/>')

    def dots(self, points, style, radius=3.2, titles=None):
        for i, (x, y) in enumerate(points):
            title = f"<title>{escape(titles[i])}</title>" if titles else ""
            self.add(f'<circle cx="{self.px(x):.1f}" cy="{self.py(y):.1f}" r="{radius}" class="dot {style}">{title}</circle>')

    def band(self, points, style):
        """points: (x, low, high)."""
        edge = [(x, high) for x, _, high in points] + [(x, low) for x, low, _ in reversed(points)]
        path = " ".join(f"{self.px(x):.1f},{self.py(y):.1f}" for x, y in edge)
        self.add(f'<polygon points="{path}" class="band {style}"/>')

    def bar(self, x, y, width, height, style, title=""):
        inner = f"<title>{escape(title)}</title>" if title else ""
        self.add(f'<rect x="{x:.1f}" y="{y:.1f}" width="{max(width, 0):.1f}" height="{max(height, 0):.1f}" rx="1.5" class="{style}">{inner}</rect>')

    def end_label(self, x, y, words, style):
        """A name at the end of a line; labels that would overlap move apart when the chart is written."""
        self.end_labels.append([self.py(y), self.px(x), words, style])

    def place_end_labels(self):
        self.end_labels.sort()
        gap = FONT_PX + 2
        for i in range(1, len(self.end_labels)):
            self.end_labels[i][0] = max(self.end_labels[i][0], self.end_labels[i - 1][0] + gap)
        overflow = self.end_labels[-1][0] - (self.height - self.bottom) if self.end_labels else 0
        for label in self.end_labels:
            y = label[0] - max(overflow, 0)
            self.add(f'<text x="{label[1] + 7:.1f}" y="{y + 4:.1f}" class="label {label[3]}">{escape(label[2])}</text>')

    def svg(self):
        self.place_end_labels()
        self.end_labels = []
        return (f'<svg viewBox="0 0 {self.width} {self.height}" role="img" aria-label="{escape(self.label)}" style="max-width:{self.width * 1.1:.0f}px">'
                + "".join(self.parts) + "</svg>")


def figure(content, caption="", title=""):
    head = f"<h4>{escape(title)}</h4>" if title else ""
    foot = f"<figcaption>{caption}</figcaption>" if caption else ""
    return f"<figure>{head}{content}{foot}</figure>"


def table(header, rows, row_classes=None, caption=""):
    """Cells are HTML; a (HTML, style) pair styles one. The first column is a row's name."""
    def cell(tag, content, index):
        style = ""
        if isinstance(content, tuple):
            content, style = content
        scope = ' scope="row"' if tag == "th" and index == 0 else ""
        return f"<{tag}{scope}{' style=' + chr(34) + style + chr(34) if style else ''}>{content}</{tag}>"

    lines = ["<tr>" + "".join(f"<th>{name}</th>" for name in header) + "</tr>"]
    body = []
    for number, row in enumerate(rows):
        kind = f' class="{row_classes[number]}"' if row_classes and row_classes[number] else ""
        body.append(f"<tr{kind}>" + "".join(cell("th" if i == 0 else "td", content, i) for i, content in enumerate(row)) + "</tr>")
    head = f'<p class="note above">{caption}</p>' if caption else ""
    return f'{head}<div class="scroll"><table><thead>{"".join(lines)}</thead><tbody>{"".join(body)}</tbody></table></div>'


def heat(percent):
    """The shade of a recall: the fuller, the better."""
    return f"background:color-mix(in srgb, var(--heat) {max(0.0, min(100.0, percent)) * 0.42:.0f}%, transparent)"


def legend(names):
    return '<p class="legend">' + "".join(f'<span class="{series_class(n)}"><i></i>{escape(n)}</span>' for n in names) + "</p>"
