# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Writes the report's page from the results of report.sh: one file, which needs neither a network nor another file.

    python3 scripts/report --results DIR --out report.html [--accuracy FILE] [--commit TEXT] [--seed N] [--quick true|false]
"""

import argparse
import datetime
import json
import pathlib
import sys

import adaptation
import cost
import paper
import trust
from charts import escape
from load import SUITES, BadResults, Results

SECTIONS = [("adaptation", "Adapting a forest to another scene", adaptation.adaptation, "adapt"), ("loss", "Losing track at every frame", adaptation.loss, "loss"),
            ("novelty", "Views far from everything learnt", adaptation.novelty, "novel"), ("cost", "Time and memory", cost.timing, "time"),
            ("confidence", "What confidence is worth", cost.confidence, "confidence"), ("kidnap", "Kidnaps", cost.kidnap, "kidnap"),
            ("scale", "Many places in one map", trust.scale, "scale"), ("trust", "How far answers can be trusted", trust.trust, "trust"),
            ("failures", "Failures, looked at", cost.failures, "failures")]


def has(results, experiment):
    return any(name.split(".")[1] == experiment for name in results.documents)


def tiles(results):
    """The few numbers to remember."""
    shown = []
    for suite, document in results.suites("adapt"):
        shipped = [a for a in document["averages"] if a["forest"] == "default"]
        best = max(shipped or document["averages"], key=lambda a: a["recall"]["5cm_5deg"])
        name = best["method"] + (f", {best['forest']} forest" if best["forest"] else "")
        shown.append((f"{100 * best['recall']['5cm_5deg']:.1f} %", f"found within 5 cm and 5° on average, {SUITES[suite].lower()} ({name})"))
    for suite, document in results.suites("time"):
        method = document["methods"].get("forest")
        if method:
            train, relocalise = (method["timing"][key]["median"] for key in cost.clock(document))
            shown.append((f"{relocalise:.1f} ms", f"to relocalise, {train:.1f} ms to learn a frame; the paper: {paper.TIMINGS['forest'][1]:g} and {paper.TIMINGS['forest'][0]:g} ms on a GPU"))
    for suite, document in results.suites("novel"):
        ratio = document["area_ratios"].get("forest / ferns")
        if ratio:
            shown.append((f"{ratio:.1f}×", f"the area under the novelty curve of random ferns, {SUITES[suite].lower()}"))
    for suite, document in results.suites("confidence"):
        method = document["methods"].get("forest")
        if method:
            at = method["at_threshold"]
            shown.append((f"{at['false_accepts']}", f"false accepts in {method['num_samples']} views while believing {100 * at['recall']:.1f} % rightly, {SUITES[suite].lower()}"))
    return '<div class="tiles">' + "".join(f'<div class="tile"><b>{escape(value)}</b><span>{escape(text)}</span></div>' for value, text in shown) + "</div>"


def reproduce(results, options):
    steps = results.seconds()
    total = sum(steps.values())
    lines = f"scripts/report.sh{' --quick' if options.quick == 'true' else ''}{f' --seed {options.seed}' if options.seed != 42 else ''}"
    slowest = sorted(steps.items(), key=lambda step: -step[1])[:5]
    told = f" Its experiments took {total / 60:.1f} minutes; the longest: " + ", ".join(f"{escape(name)} {seconds} s" for name, seconds in slowest) + "." if total else ""
    return (f"<p>One command writes this page.{told}</p><pre>{escape(lines)}</pre><p>Each experiment is one call of <code>relocalisation_benchmark</code>; "
            "its JSON lies beside this page, and <code>accuracy.json</code> holds every number that equal seeds reproduce. "
            "Intervals treat frames as independent; neighbouring frames are alike, so the truth is wider.</p>")


def page(results, options):
    machine = results.machine()
    stamp = f"Foothold {escape(options.commit)} · {escape(machine['processor'] or 'unknown processor')}, {machine['num_threads']} threads · seed {options.seed} · {datetime.date.today().isoformat()}"
    if options.quick == "true":
        stamp += " · quick: few frames, wide intervals"
    body, links = [], []
    for key, title, make, experiment in SECTIONS:
        content = make(results) if has(results, experiment) else ""
        if content:
            links.append(f'<a href="#{key}">{title}</a>')
            body.append(f'<section><h2 id="{key}">{title}</h2>{content}</section>')
    style = (pathlib.Path(__file__).parent / "style.css").read_text(encoding="utf-8")
    return (f'<!doctype html><html lang="en-GB"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width,initial-scale=1"><title>Foothold: the experiments</title>'
            f"<style>{style}</style></head><body><header><h1>Finding a lost camera</h1>"
            '<p class="lead">The experiments of <em>On-the-Fly Adaptation of Regression Forests for Online Camera Relocalisation</em>, repeated with Foothold, beside the paper’s numbers where it has them.</p>'
            f'<p class="stamp">{stamp}</p><nav>{"".join(links)}</nav></header><main>{tiles(results)}{"".join(body)}'
            f'<section><h2 id="reproduce">How to repeat this</h2>{reproduce(results, options)}</section></main><footer>{stamp}</footer></body></html>\n')


def write(path, text):
    """The file appears complete or not at all."""
    temporary = pathlib.Path(str(path) + ".part")
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def main():
    parser = argparse.ArgumentParser(prog="report", description="Writes the report's page from the results of report.sh.")
    parser.add_argument("--results", required=True)
    parser.add_argument("--out", required=True)
    parser.add_argument("--accuracy")
    parser.add_argument("--commit", default="unknown")
    parser.add_argument("--seed", type=int, default=42)
    parser.add_argument("--quick", choices=["true", "false"], default="false")
    options = parser.parse_args()
    try:
        results = Results(options.results)
    except BadResults as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    write(options.out, page(results, options))
    if options.accuracy:
        write(options.accuracy, json.dumps(results.accuracy(), indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
