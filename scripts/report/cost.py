# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""The sections on what it costs, what confidence is worth, recovery from kidnaps, and failures."""

import base64

import paper
from charts import Axis, Chart, escape, figure, heat, legend, percent_tick, series_class, table
from load import SUITES

QUANTITIES = {"trained_frames": "frames learnt", "image_width_px": "image width [px]", "hypotheses": "hypotheses drawn", "leaves": "leaves of the forest"}
STAGE_TITLES = {"correspondences": "leaves and modes", "features": "features", "hypotheses": "hypotheses", "ransac": "pre-emptive RANSAC", "refine": "refinement",
                "cluster": "clustering", "insert": "reservoirs", "encode": "fern codes", "search": "keyframe search", "upload": "upload", "rank": "ranking"}
NUM_STAGE_COLOURS = 8  # of style.css


def spread(ms, digits=2):
    return "–" if ms["median"] is None else f"{ms['median']:.{digits}f} <small>/ {ms['p95']:.{digits}f}</small>"


def clock(document):
    """Keys of durations: processor time where it is the whole work, since it does not depend on what else the machine does."""
    settings = document["settings"]
    kind = "_cpu_ms" if settings["device"] == "cpu" and settings["threads"] == 1 else "_ms"
    return "train" + kind, "relocalise" + kind


def stages_of(timing, call):
    return [(stage.split("/", 1)[1], ms["median"]) for stage, ms in timing["stages_ms"].items() if stage.startswith(call + "/") and ms["median"] is not None]


def stage_chart(methods, call):
    """A bar per method, divided into its stages; its length is the sum of their medians."""
    bars = [(name, stages_of(method["timing"], call)) for name, method in methods]
    longest = max(sum(ms for _, ms in stages) for _, stages in bars) or 1
    stage_names = list(dict.fromkeys(stage for _, stages in bars for stage, _ in stages))
    chart = Chart(Axis(0, longest), Axis(0, len(bars)), width=440, height=34 + 34 * len(bars), left=66, right=62, top=4, bottom=30, label=f"Stages of {call}")
    chart.draw_axes(y_ticks=[], x_title="")
    chart.text(chart.width - chart.right + 10, chart.height - chart.bottom + 17, "ms", "start")
    for index, (name, stages) in enumerate(bars):
        y, done = chart.py(len(bars) - index) + 5, 0.0
        chart.text(chart.left - 8, y + 15, name, "end", "value")
        for stage, ms in stages:
            chart.bar(chart.px(done), y, chart.px(done + ms) - chart.px(done), 22, f"stage{stage_names.index(stage) % NUM_STAGE_COLOURS}", f"{stage}: {ms:.2f} ms")
            done += ms
        chart.text(chart.px(done) + 7, y + 15, f"{done:.1f}" if done >= 1 else f"{done:.2f}", "start", "value")
    key = '<p class="legend">' + "".join(f'<span><i class="box stage{i % NUM_STAGE_COLOURS}"></i>{escape(STAGE_TITLES.get(s, s))}</span>'
                                         for i, s in enumerate(stage_names)) + "</p>"
    return key + chart.svg()


def sweep_chart(sweep, train_key, relocalise_key):
    points = sweep["points"]
    values = [p["value"] for p in points]
    highest = max(p["timing"][relocalise_key]["p95"] for p in points)
    chart = Chart(Axis(values[0], values[-1], log=True), Axis(0, highest * 1.05), right=88, bottom=26, height=210, label=f"Cost against {sweep['quantity']}")
    chart.draw_axes(x_ticks=values, y_format=lambda v: f"{v:g}")
    for key, name, style in ((train_key, "learn", "s-forest-icp"), (relocalise_key, "relocalise", "s-forest")):
        chart.band([(p["value"], p["timing"][key]["median"], p["timing"][key]["p95"]) for p in points], style)
        chart.line([(p["value"], p["timing"][key]["median"]) for p in points], style)
        titles = [f"{p['value']:g}: {p['timing'][key]['median']:.2f} ms, {100 * p['recall']['5cm_5deg']:.1f} % found" for p in points]
        chart.dots([(p["value"], p["timing"][key]["median"]) for p in points], style, 3.2, titles)
        chart.end_label(values[-1], points[-1]["timing"][key]["median"], name, style)
    recalls = ", ".join(f"{100 * p['recall']['5cm_5deg']:.0f}" for p in points)
    return figure(chart.svg(), f"ms, median to 95th percentile. Found: {recalls} %.", f"{QUANTITIES[sweep['quantity']]}")


def timing(results):
    parts = []
    for suite, document in results.suites("time"):
        methods = list(document["methods"].items())
        train_key, relocalise_key = clock(document)
        rows, kinds = [], []
        for name, method in methods:
            t = method["timing"]
            rows.append([escape(name), spread(t[train_key]), spread(t[relocalise_key]), f"{100 * method['recall']['5cm_5deg']:.1f}", f"{method['state_mb']:.1f}"])
            kinds.append("")
        for name, key in (("the paper's forest, on a GPU", "forest"), ("the paper's random ferns", "ferns")):
            rows.append([name, f"{paper.TIMINGS[key][0]:g}", f"{paper.TIMINGS[key][1]:g}", "–", "–"])
            kinds.append("paper")
        threads = document["settings"]["threads"]
        where = document["settings"]["device"].upper() + (f", {threads} thread" + ("s" if threads != 1 else "") if threads else "")
        caption = f"{where}; {document['settings']['train_frames']} frames learnt, {document['settings']['test_frames']} tested; median / 95th percentile" + (" of processor time" if "cpu" in train_key else "")
        parts.append(table(["method", "learn a frame, ms", "relocalise, ms", "found %", "scene, MB"], rows, kinds, caption))
        charts = "".join(figure(stage_chart([m for m in methods if stages_of(m[1]["timing"], call)], call), "Wall clock, sum of the stages' medians.", title)
                         for call, title in (("train", "Learning a frame, by stage"), ("relocalise", "Relocalising, by stage")))
        parts.append(f'<div class="grid2">{charts}</div>')
        for method in dict.fromkeys(s["method"] for s in document["sweeps"]):
            sweeps = "".join(sweep_chart(s, train_key, relocalise_key) for s in document["sweeps"] if s["method"] == method)
            parts.append(f"<h3>How the cost of {escape(method)} grows</h3><div class=\"grid2\">{sweeps}</div>")
    return "<p>What one frame costs while the camera is tracked (learning), and once it is lost (relocalising). The paper's times are those of an NVIDIA GeForce Titan Black.</p>" + "".join(parts)


def roc_chart(document, suite):
    # Beyond where recall still grows, laxer thresholds only add false accepts.
    highest = 0.01
    for method in document["methods"].values():
        most = max(p["recall"] for p in method["curve"])
        highest = max(highest, 1.3 * min(p["false_accept_rate"] for p in method["curve"] if p["recall"] == most))
    chart = Chart(Axis(0, 100 * highest), Axis(0, 100), width=420, height=260, right=120, label=f"Recall against false accepts, {SUITES[suite]}")
    chart.draw_axes(y_ticks=[0, 25, 50, 75, 100], x_title="false accepts, % of all views", y_format=percent_tick)
    for name, method in reversed(list(document["methods"].items())):
        shown = [p for p in method["curve"] if p["false_accept_rate"] <= highest]
        chart.line([(100 * p["false_accept_rate"], 100 * p["recall"]) for p in shown] + [(100 * highest, 100 * shown[-1]["recall"])], series_class(name))
        at = method["at_threshold"]
        chart.dots([(100 * at["false_accept_rate"], 100 * at["recall"])], series_class(name) + " hollow", 5,
                   [f"{name} at its threshold: {100 * at['recall']:.1f} % found, {at['false_accepts']} false accepts"])
        chart.end_label(100 * highest, 100 * shown[-1]["recall"], name, series_class(name))
    return chart.svg()


def calibration_chart(document, suite):
    chart = Chart(Axis(0, 1), Axis(0, 100), width=420, height=260, label=f"Calibration, {SUITES[suite]}")
    chart.draw_axes(x_ticks=[0, 0.25, 0.5, 0.75, 1], y_ticks=[0, 25, 50, 75, 100], x_title="confidence", y_format=percent_tick)
    chart.add(f'<line x1="{chart.px(0):.1f}" y1="{chart.py(0):.1f}" x2="{chart.px(1):.1f}" y2="{chart.py(100):.1f}" class="mark"/>')
    for name, method in reversed(list(document["methods"].items())):
        bins = [b for b in method["calibration"] if b["num_answers"] >= 5]
        if not bins:
            continue
        for b in bins:
            x = chart.px(b["mean_confidence"])
            chart.add(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{chart.py(100 * b["right_95"][0]):.1f}" y2="{chart.py(100 * b["right_95"][1]):.1f}" class="line thin {series_class(name)}"/>')
        chart.line([(b["mean_confidence"], 100 * b["num_right"] / b["num_answers"]) for b in bins], series_class(name))
        chart.dots([(b["mean_confidence"], 100 * b["num_right"] / b["num_answers"]) for b in bins], series_class(name), 3.6,
                   [f"{name}: {b['num_right']} of {b['num_answers']} right" for b in bins])
    return legend(list(document["methods"])) + chart.svg()


def confidence(results):
    parts = []
    for suite, document in results.suites("confidence"):
        rows = []
        for name, m in document["methods"].items():
            at, clean = m["at_threshold"], m["without_false_accepts"]
            area = "–" if m["roc_area"] is None else f"{m['roc_area']:.3f}"
            error = "–" if m["calibration_error"] is None else f"{m['calibration_error']:.3f}"
            rows.append([escape(name), f"{100 * m['curve'][-1]['recall']:.1f}", (f"{100 * at['recall']:.1f}", heat(100 * at["recall"])), f"{at['false_accepts']} of {m['num_samples']}",
                         f"{100 * clean['recall']:.1f}", area, error])
        header = ["method", "found %", "found and believed %", "false accepts", "best without any %", "ROC area", "calibration error"]
        parts.append(f"<h3>{SUITES[suite]}</h3>" + table(header, rows) + '<div class="grid2">' +
                     figure(roc_chart(document, suite), "Every threshold on the confidence is a point; the ring is the threshold that the method asks for. Up and left is better.", "Recall against false accepts") +
                     figure(calibration_chart(document, suite), "Answers of equal confidence, and how many of them are right (10 cm, 10°), with 95 % intervals; bins of fewer than five are left out. The dashed line is a perfect calibration.", "Does confidence come true?") + "</div>")
    return ("<p>A relocaliser that says a wrong pose with confidence does harm. Each scene is asked about its own test views and about those of another scene, where any accepted answer "
            "is false. <em>False accept</em>: believed, but off by more than 10 cm or 10°. The paper does not report this.</p>" + "".join(parts))


KIDNAP_CAPTION = ("Each mark is one kidnap, in the order of the recording: filled if the camera was found again within the judged frames, hollow if not; a cross means that a wrong pose was believed "
                  "at least once. Small marks: places that had not been seen before.")


def kidnap_strips(results, suite):
    """A row of marks per scene and method."""
    rows = [(scene, name, m["kidnaps"]) for scene, document in results.parts(suite, "kidnap") for name, m in document["methods"].items()]
    most = max(len(kidnaps) for _, _, kidnaps in rows)
    left = 20 + max(len(f"{scene} {name}") for scene, name, _ in rows) * 7
    chart = Chart(Axis(0, most), Axis(0, len(rows)), width=left + 18 * most + 20, height=14 + 28 * len(rows), left=left, top=4, bottom=6, label="Outcome of every kidnap")
    for index, (scene, name, kidnaps) in enumerate(rows):
        y = len(rows) - index - 0.5
        chart.text(left - 10, chart.py(y) + 4, f"{scene} {name}", "end", "value")
        for number, kidnap_ in enumerate(kidnaps):
            found = "found after " + str(kidnap_["frames_to_recovery"]) + " frames" if kidnap_["recovered"] else "not found"
            title = f"{kidnap_['kind']}, frame {kidnap_['from']} to {kidnap_['to']}: {found}, {kidnap_['num_wrong_believed']} wrong poses believed"
            chart.dots([(number + 0.5, y)], series_class(name) + ("" if kidnap_["recovered"] else " hollow"), 6 if kidnap_["seen_before"] else 3.5, [title])
            if kidnap_["num_wrong_believed"] > 0:
                x, py = chart.px(number + 0.5), chart.py(y)
                chart.add(f'<path d="M{x - 5:.1f} {py - 5:.1f}l10 10m-10 0l10 -10" class="line s-wrong"/>')
    return chart.svg()


def kidnap(results):
    parts = []
    for suite in SUITES:
        rows = []
        for scene, document in results.parts(suite, "kidnap"):
            for name, m in document["methods"].items():
                frames = "–" if m["median_frames_to_recovery"] is None else f"{m['median_frames_to_recovery']:g}"
                ms = m["timing"]["median_ms_to_recovery"]
                rows.append([f"{escape(scene)} <small>{escape(name)}</small>", f"{m['num_recovered']} of {m['num_kidnaps']}", f"{m['num_seen_before_recovered']} of {m['num_seen_before']}",
                             frames, "–" if ms is None else f"{ms:.0f}", str(m["num_false_resumes"]), str(m["num_wrong_fusions"])])
        if rows:
            header = ["scene", "resumed rightly", "where seen before", "frames, median", "ms, median", "resumed wrongly", "frames fused wrongly"]
            parts.append(f"<h3>{SUITES[suite]}</h3>" + table(header, rows) + figure(kidnap_strips(results, suite), KIDNAP_CAPTION))
    if not parts:
        return ""
    return ("<p>The closed loop: tracker, gate, relocaliser and map together. Frames are removed from the recording, so that the camera is suddenly elsewhere, in a place that was mapped before. "
            "<em>Resumed</em> is judged against the undisturbed run at 10 cm and 10°, so that drift of the map does not count.</p>" + "".join(parts))


def failures(results):
    parts = []
    for suite in SUITES:
        for scene, document in results.parts(suite, "failures"):
            for case in document["cases"]:
                pictures = []
                for name, caption in (("candidates_picture", "The live frame, the truth, and the last 16 hypotheses with their energies. Dots are correspondences whose leaf has a mode where the hypothesis puts them; equal colours are equal pixels. Green frames: within 5 cm and 5°."),
                                      ("modes_picture", "Four of the pixels that support the first hypothesis, and every place in the map that their leaves offer for them.")):
                    data = results.picture(case[name]) if case.get(name) else None
                    if data:
                        pictures.append(figure(f'<img alt="{escape(name)} of frame {case["frame"]} in {escape(scene)}" loading="lazy" src="data:image/png;base64,{base64.b64encode(data).decode()}">', caption))
                error = "no answer" if case["translation_error_m"] is None else f"{100 * case['translation_error_m']:.0f} cm and {case['rotation_error_deg']:.0f}° off"
                right = "none of its candidates is right" if case["first_right_candidate"] is None else f"its candidate {case['first_right_candidate']} is right"
                parts.append(f"<h3>{escape(scene)}, frame {case['frame']}: {error}</h3><p class=\"note\">Confidence {case['confidence']:.2f}; {right}.</p>" + "".join(pictures))
    if not parts:
        return ""
    return "<p>What went wrong where relocalisation failed, in the manner of the paper's supplementary material.</p>" + "".join(parts)
