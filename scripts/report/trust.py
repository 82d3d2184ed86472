# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""The sections on many places in one map, and on how far answers can be trusted."""

from charts import Axis, Chart, escape, figure, legend, percent_tick, series_class, table
from load import SUITES

ENDINGS = [("right_believed", "right, believed", "end-right"), ("right_unbelieved", "right, not believed", "end-timid"), ("neither", "neither", "end-neither"),
           ("wrong_believed", "wrong, believed", "end-wrong")]


def growth_chart(document, value, highest, label, y_format):
    """A line per method over the number of places."""
    curves = {name: [(p["places"], value(p)) for p in m["points"]] for name, m in document["methods"].items()}
    amounts = sorted({x for points in curves.values() for x, _ in points})
    chart = Chart(Axis(amounts[0], amounts[-1], log=amounts[-1] > amounts[0]), Axis(0, highest), label=label)
    chart.draw_axes(x_ticks=amounts, x_title="places in the map", y_format=y_format)
    for name, points in curves.items():
        chart.line(points, series_class(name))
        chart.dots(points, series_class(name), 3.4, [f"{name}, {x} places: {y:.1f}" for x, y in points])
    return legend(list(curves)) + chart.svg()


def scale(results):
    parts = []
    for suite, document in results.suites("scale"):
        points = [p for m in document["methods"].values() for p in m["points"]]
        rows = []
        for name, m in document["methods"].items():
            for amount, p in [("each alone", m["alone"])] + [(p["places"], p) for p in m["points"]]:
                ms = p["timing"]["relocalise_ms"]
                rows.append([f"{escape(amount)} <small>{escape(name)}</small>"] + [f"{100 * p['recall'][key]:.1f}" for key in ("1cm_1deg", "2cm_2deg", "5cm_5deg", "10cm_10deg")] +
                            [f"{100 * p['confidence']['num_accepted'] / p['num_tested']:.1f}", f"{p['confidence']['false_accepts']} of {p['num_tested']}",
                             f"{ms['median']:.1f} <small>/ {ms['p95']:.1f}</small>", f"{p['timing']['last_train_ms']['median']:.1f}", f"{p['state_mb']:.1f}"])
        header = ["places in the map", "1 cm, 1° %", "2 cm, 2° %", "5 cm, 5° %", "10 cm, 10° %", "believed %", "false accepts", "relocalise, ms", "learn, ms", "MB"]
        charts = (figure(growth_chart(document, lambda p: 100 * p["recall"]["5cm_5deg"], 100, "Recall", percent_tick), "Found within 5 cm and 5°.") +
                  figure(growth_chart(document, lambda p: p["state_mb"], 1.05 * max(p["state_mb"] for p in points) or 1, "Memory", lambda v: f"{v:g}"), "Memory of the map [MB]."))
        parts.append(f"<h3>{SUITES[suite]}</h3>" + table(header, rows) + f'<div class="grid2">{charts}</div>')
    if not parts:
        return ""
    return ("<p>Places side by side in one map, learnt one after another, and always the same few of them tested. A map that forgets loses recall from the left to the right; one that grows "
            "without need does so in memory.</p>" + "".join(parts))


def ending_bars(method):
    """How the questions of each kind ended."""
    kinds = list(method["kinds"].items())
    left = 20 + max(len(kind) for kind, _ in kinds) * 7
    chart = Chart(Axis(0, 1), Axis(0, len(kinds)), width=760, height=12 + 22 * len(kinds), left=left, right=86, top=4, bottom=6, label="How questions ended, by kind")
    for index, (kind, counts) in enumerate(kinds):
        y, done = chart.py(len(kinds) - index) + 3, 0.0
        chart.text(left - 8, y + 12, kind, "end", "value")
        shares = {**counts, "neither": counts["wrong_unbelieved"] + counts["unanswered"]}
        for key, name, style in ENDINGS:
            part = shares[key] / max(1, counts["num_questions"])
            chart.bar(chart.px(done), y, chart.px(done + part) - chart.px(done), 16, style, f"{name}: {shares[key]} of {counts['num_questions']}")
            done += part
        chart.text(chart.width - 4, y + 12, f"{counts['wrong_believed']} of {counts['num_questions']}", "end", "value")
    key = '<p class="legend">' + "".join(f'<span><i class="box {style}"></i>{name}</span>' for _, name, style in ENDINGS) + "</p>"
    return key + chart.svg()


def risk_chart(document):
    curves = {name: [(100 * p["coverage"], 100 * p["risk"]) for p in m["risk_coverage"] if p["coverage"] > 0] for name, m in document["methods"].items()}
    highest = max([risk for points in curves.values() for _, risk in points] + [1])
    chart = Chart(Axis(0, 100), Axis(0, 1.05 * highest), label="Risk against coverage")
    chart.draw_axes(x_title="believed, % of all questions", x_format=percent_tick)
    for name, points in curves.items():
        if points:
            chart.line(points, series_class(name))
    return legend(list(curves)) + chart.svg()


def reliability_chart(document):
    chart = Chart(Axis(0, 1), Axis(0, 100), label="Reliability")
    chart.draw_axes(x_title="confidence", y_format=percent_tick)
    chart.add(f'<line x1="{chart.px(0):.1f}" y1="{chart.py(0):.1f}" x2="{chart.px(1):.1f}" y2="{chart.py(100):.1f}" class="grid" stroke-dasharray="4 4"/>')
    for name, m in document["methods"].items():
        points = [(b["mean_confidence"], 100 * b["num_right"] / b["num_answers"]) for b in m["reliability"] if b["num_answers"] >= 5]
        if points:
            chart.line(points, series_class(name))
            chart.dots(points, series_class(name), 3.4)
    return legend(list(document["methods"])) + chart.svg()


def interval(counts, ending, limits):
    low, high = counts[limits]
    return f"{counts[ending]} <small>[{100 * low:.2f}, {100 * high:.2f} %]</small>"


def trust(results):
    parts = []
    for suite, document in results.suites("trust"):
        for name, m in document["methods"].items():
            rows = [[escape(kind), str(c["num_questions"]), interval(c, "right_believed", "right_believed_95"), str(c["right_unbelieved"]),
                     interval(c, "wrong_believed", "wrong_believed_95")] for kind, c in [*m["kinds"].items(), ("all of another place", m["elsewhere"]), ("all", m["all"])]]
            error = "–" if m["calibration_error"] is None else f"{m['calibration_error']:.3f}"
            parts.append(f"<h3>{SUITES[suite]}: {escape(name)}</h3>" + table(["kind of question", "questions", "right, believed", "right, not believed", "wrong, believed"], rows) +
                         figure(ending_bars(m), f"To the right: wrong and believed, of all. Expected calibration error over all answers: {error}.", "How questions ended"))
        parts.append('<div class="grid2">' + figure(risk_chart(document), "The share of the believed answers that is wrong, in percent, as the threshold falls from left to right. Lower is better.", "Risk against coverage") +
                     figure(reliability_chart(document), "Answers of equal confidence, and how many are right; bins of fewer than five are left out. The dashed line is a perfect calibration.", "Reliability") + "</div>")
    if not parts:
        return ""
    return ("<p>Many maps, and many questions to each: about its own place, learnt, half learnt and not learnt at all, in other light, blurred, with holes and people, with furniture moved; about "
            "places that look alike; and about other scenes. Right means within 10 cm and 10°. Intervals are 95 % Wilson intervals of the share of all questions.</p>" + "".join(parts))
