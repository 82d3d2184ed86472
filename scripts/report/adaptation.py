# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""The sections on adapting forests: the paper's Tables 1 and 2, tracking loss (4.2) and novel poses (4.3)."""

import paper
from charts import Axis, Chart, escape, figure, heat, legend, percent_tick, series_class, table
from load import SUITES, found

MIN_FRAMES_SHOWN = 5  # fewer say nothing about a bin's recall


def percent(fraction, digits=1):
    return "–" if fraction is None else f"{100 * fraction:.{digits}f}"


def title_of(scene):
    return paper.SCENE_TITLES.get(scene, scene)


def rows_of(document):
    """(forest, method) -> {scene: run}, in the order of the runs."""
    rows = {}
    for run in document["runs"]:
        rows.setdefault((run["forest"], run["method"]), {})[run["scene"]] = run
    return rows


def recall_cell(run):
    if run is None:
        return "–"
    value = 100 * run["recall"]["5cm_5deg"]
    low, high = run["recall_5cm_5deg_95"]
    return (f'<span title="{run["num_tested"]} frames, 95 % interval {100 * low:.1f} to {100 * high:.1f}">{value:.1f}</span>', heat(value))


def adaptation_table(document, suite):
    scenes = [scene["name"] for scene in document["scenes"]]
    rows, kinds = [], []
    for (forest, method), runs in rows_of(document).items():
        average = sum(run["recall"]["5cm_5deg"] for run in runs.values()) / len(runs)
        rows.append([f"{escape(forest or '–')} <small>{escape(method)}</small>", *[recall_cell(runs.get(scene)) for scene in scenes],
                     (f"<b>{percent(average)}</b>", heat(100 * average))])
        kinds.append("")
    frames = {run["scene"]: run["num_tested"] for run in document["runs"]}
    rows.append(["frames tested", *[str(frames[scene]) for scene in scenes], ""])
    kinds.append("group")
    if suite == "7scenes":
        for forest in ("office", "author's desk"):
            for values, name in zip(paper.ADAPTATION[forest], ("", " + ICP")):
                known = dict(zip(paper.SCENES, values))
                rows.append([f"the paper, {forest}{name}", *[f"{known[s]:.1f}" if s in known else "–" for s in scenes],
                             f"{paper.average([known[s] for s in scenes if s in known]):.1f}"])
                kinds.append("paper")
        for name, values in paper.OFFLINE.items():
            known = dict(zip(paper.SCENES, values))
            rows.append([f"{name}, trained on the scene", *[f"{known[s]:.1f}" if s in known else "–" for s in scenes],
                         f"{paper.average([known[s] for s in scenes if s in known]):.1f}"])
            kinds.append("paper")
    header = ["forest trained on", *[escape(title_of(scene)) for scene in scenes], "average"]
    return table(header, rows, kinds, "% of test frames within 5 cm and 5°; hover for intervals")


def paper_table():
    rows, kinds = [], []
    for forest, (alone, refined) in paper.ADAPTATION.items():
        for values, name in ((alone, "alone"), (refined, "+ ICP")):
            rows.append([f"{escape(title_of(forest))} <small>{name}</small>", *[(f"{value:.1f}", heat(value)) for value in values],
                         (f"<b>{paper.average(values):.1f}</b>", heat(paper.average(values)))])
            kinds.append("")
    return table(["forest trained on", *[title_of(s) for s in paper.SCENES], "average"], rows, kinds)


def strip_chart(columns, label):
    """columns: (scene, [(name, percent, style)]). One row of dots per scene."""
    height = 60 + 30 * len(columns)
    left = 30 + max(len(scene) for scene, _ in columns) * 7
    chart = Chart(Axis(0, 100), Axis(0, len(columns)), width=400, height=height, left=left, label=label)
    chart.draw_axes(x_ticks=[0, 25, 50, 75, 100], y_ticks=[], x_title="% within 5 cm and 5°")
    for index, (scene, dots) in enumerate(columns):
        y = len(columns) - index - 0.5
        low, high = min(v for _, v, _ in dots), max(v for _, v, _ in dots)
        chart.text(left - 8, chart.py(y) + 4, scene, "end", "value")
        chart.add(f'<line x1="{chart.px(0):.1f}" x2="{chart.px(100):.1f}" y1="{chart.py(y):.1f}" y2="{chart.py(y):.1f}" class="grid"/>')
        chart.bar(chart.px(low), chart.py(y) - 3, chart.px(high) - chart.px(low), 6, "faint")
        styles = list(dict.fromkeys(style for _, _, style in dots))
        for name, value, style in dots:  # methods side by side, so that equal ones do not hide each other
            shift = 0.2 * ((len(styles) - 1) / 2 - styles.index(style))
            chart.dots([(value, y + shift)], style, 3.8, [f"{name}: {value:.1f} %"])
    return chart.svg()


def adaptation(results):
    parts = []
    for suite, document in results.suites("adapt"):
        scenes = [scene["name"] for scene in document["scenes"]]
        ours = []
        for scene in scenes:
            dots = [(f"{run['forest'] or run['method']}, {run['method']}", 100 * run["recall"]["5cm_5deg"], series_class(run["method"]))
                    for run in document["runs"] if run["scene"] == scene]
            ours.append((title_of(scene), dots))
        theirs = [(title_of(scene), [(f"{forest}, alone", alone[i], "s-forest") for forest, (alone, _) in paper.ADAPTATION.items()] +
                   [(f"{forest}, with ICP", refined[i], "s-forest-icp") for forest, (_, refined) in paper.ADAPTATION.items()])
                  for i, scene in enumerate(paper.SCENES)]
        methods = list(dict.fromkeys(run["method"] for run in document["runs"]))
        parts.append(f"<h3>{SUITES[suite]}</h3>" + adaptation_table(document, suite))
        figures = [figure(legend(methods) + strip_chart(ours, f"Recall of every forest on each of {SUITES[suite]}"), "Each dot is one forest, adapted to that scene.", "Ours")]
        if not parts[1:]:
            figures.append(figure(legend(["forest", "forest+icp"]) + strip_chart(theirs, "The paper's Table 1 as dots"), "Eight forests, alone and with ICP. Other scenes, same protocol.",
                                  "The paper's Table 1, on 7-Scenes"))
        parts.append(f'<div class="grid2">{"".join(figures)}</div>')
    return ("<p>A forest is trained once, on one scene. Its leaves are emptied and refilled, frame by frame, on another; then every frame of a second path through that "
            "scene is relocalised. Rows are forests, columns the scenes they are adapted to. <em>data-free</em> has random branches and has seen nothing.</p>"
            + "".join(parts) + f"<details><summary>The paper's Table 1 in full</summary>{paper_table()}</details>")


def moving_recall(lines, window):
    flags = [found(line) for line in lines]
    return [(int(lines[i]["frame"]), 100 * sum(flags[max(0, i + 1 - window):i + 1]) / len(flags[max(0, i + 1 - window):i + 1])) for i in range(len(flags))]


def loss_chart(name, methods):
    lines = next(iter(methods.values()))
    window = max(5, min(50, len(lines) // 10))
    chart = Chart(Axis(int(lines[0]["frame"]), int(lines[-1]["frame"])), Axis(0, 100), label=f"Recall over the frames of {name}", right=92)
    chart.draw_axes(y_ticks=[0, 25, 50, 75, 100], x_title="frame", y_format=percent_tick)
    y = chart.py(paper.RARELY_BELOW)
    chart.add(f'<line x1="{chart.left}" x2="{chart.width - chart.right}" y1="{y:.1f}" y2="{y:.1f}" class="mark"/>')
    for method in reversed(list(methods)):
        points = moving_recall(methods[method], window)
        chart.line(points, series_class(method))
        chart.end_label(points[-1][0], points[-1][1], method, series_class(method))
    return chart.svg(), window


def loss(results):
    parts = []
    for suite in SUITES:
        charts, rows = [], []
        parts_of_suite = [(scene, title_of(scene), "loss", d) for scene, d in results.parts(suite, "loss")]
        parts_of_suite += [(scene, f"{title_of(scene)}, 30 frames ahead", "gap", d) for scene, d in results.parts(suite, "gap")]
        for scene, title, experiment, document in parts_of_suite:
            frames = results.frames(f"{suite}.{experiment}.{scene}")
            if not frames:
                continue
            svg, window = loss_chart(title, frames)
            charts.append(figure(svg, "", title))
            cells = [escape(title), str(next(iter(document["methods"].values()))["num_tested"])]
            for method in document["methods"].values():
                first = method["first_success_frame"]
                value = 100 * method["recall"]["5cm_5deg"]
                cells += [(f"{value:.1f}", heat(value)), "–" if first is None else str(first)]
            rows.append(cells)
            names = list(document["methods"])
        if charts:
            header = ["scene", "tests"] + [part for name in names for part in (f"{escape(name)} %", "first")]
            parts.append(f'<h3>{SUITES[suite]}</h3><div class="grid3">{"".join(charts)}</div>' +
                         table(header, rows, caption=f"% within 5 cm and 5° over the whole sequence, and the first frame found; curves are means over {window} tests"))
    return ("<p>Tracking is lost at every frame: it is relocalised with what was learnt from the frames before it, and learnt afterwards. In the paper recovery begins within "
            f"{paper.FIRST_SUCCESS[0]} to {paper.FIRST_SUCCESS[1]} frames and recall rarely drops below {paper.RARELY_BELOW:.0f} % (dashed), the stairs excepted.</p>" + "".join(parts))


def bin_position(name):
    return 57 if name == "rest" else int(name.split("cm")[0])


def novelty_chart(document, suite):
    chart = Chart(Axis(2, 60), Axis(0, 100), width=440, height=260, right=120, label=f"Recall against novelty, {SUITES[suite]}")
    ticks = [10, 20, 30, 40, 50, 57]
    chart.draw_axes(x_ticks=ticks, y_ticks=[0, 25, 50, 75, 100], x_title="distance to the nearest learnt view [cm and °]",
                    y_format=percent_tick, x_format=lambda v: "more" if v == 57 else f"{v:g}")
    for name, method in reversed(list(document["methods"].items())):
        bins = [(bin_position(b["bin"]), b) for b in method["novelty"] if b["num_frames"] >= MIN_FRAMES_SHOWN]
        if not bins:
            continue
        chart.band([(x, 100 * b["recall_95"][0], 100 * b["recall_95"][1]) for x, b in bins], series_class(name))
        chart.line([(x, 100 * b["recall"]) for x, b in bins], series_class(name))
        chart.dots([(x, 100 * b["recall"]) for x, b in bins], series_class(name), 3.2,
                   [f"{name}: {b['num_found']} of {b['num_frames']} frames" for _, b in bins])
        chart.end_label(bins[-1][0], 100 * bins[-1][1]["recall"], name, series_class(name))
    return chart.svg()


def frames_chart(document):
    bins = next(iter(document["methods"].values()))["novelty"]
    most = max(max(b["num_frames"] for b in bins), 1)
    chart = Chart(Axis(2, 60), Axis(0, most), width=440, height=86, right=120, top=18, bottom=8, label="Frames in each bin")
    for b in bins:
        x = chart.px(bin_position(b["bin"]))
        chart.bar(x - 8, chart.py(b["num_frames"]), 16, chart.height - chart.bottom - chart.py(b["num_frames"]), "faint")
        chart.text(x, chart.py(b["num_frames"]) - 4, b["num_frames"], style="count")
    chart.text(chart.width - chart.right + 8, chart.height - chart.bottom, "frames", "start")
    return chart.svg()


def novelty(results):
    parts = []
    for suite, document in results.suites("novel"):
        ratios = document["area_ratios"]
        rows = []
        for name, method in document["methods"].items():
            area = method["area"]
            ratio = ratios.get(f"{name} / ferns")
            rows.append([f'<span class="{series_class(name)}"><b style="color:var(--c)">{escape(name)}</b></span>', "–" if area is None else f"{area:.3f}",
                         "1" if name == "ferns" else "–" if ratio is None else f"{ratio:.1f}"])
        caption = "Lines: share found within 5 cm and 5°, with 95 % Wilson intervals; bins of fewer than " f"{MIN_FRAMES_SHOWN} frames are left out. Bars: test frames in each bin."
        parts.append(f'<h3>{SUITES[suite]}</h3><div class="grid2">' + figure(novelty_chart(document, suite) + frames_chart(document), caption) +
                     f"<div>{table(['method', 'area', 'times ferns'], rows, caption='Mean recall of the bins up to 50 cm/50° that hold frames, and its ratio to that of random ferns; – where ferns found nothing')}</div></div>")
    return ("<p>How far may a view be from everything that was learnt? A test frame falls into the first bin for which some learnt pose is within both the distance and the angle. "
            "The paper shows its curves as a figure without numbers: its forest's decay is much less severe than that of random ferns.</p>" + "".join(parts))
