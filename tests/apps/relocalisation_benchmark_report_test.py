# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""scripts/report.sh, the page it writes, and the documents' tables, on tiny rooms."""

import html.parser
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import app_support

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
ROOM = "synthetic:{}?frames=8&width=160&height=120"
SCENES = ["--scene", ROOM.format("kitchen"), "--scene", ROOM.format("stairs"), "--settle", "2"]
LOSS = ["loss", "--sequence", ROOM.format("kitchen"), "--method", "forest,ferns"]
OFFICE = "synthetic:office?frames=300&width=320&height=240"
FAILURES = f"wrong={OFFICE}@0:60,{OFFICE}@120:122"  # a desk like the one that was learnt
EXPERIMENTS = {
    "rooms.adapt": ["adapt", *SCENES, "--method", "forest,ferns", "--forest", "data-free=random"],
    "rooms.novel": ["novel", *SCENES],
    "rooms.confidence": ["confidence", *SCENES],
    "rooms.loss.kitchen": [*LOSS, "--csv", "rooms.loss.kitchen.csv"],
    "recordings.loss.desk": [*LOSS, "--csv", "recordings.loss.desk.csv"],
    "recordings.gap.desk": [*LOSS, "--gap", "2", "--csv", "recordings.gap.desk.csv"],
    "rooms.time": ["time", "--sequence", ROOM.format("kitchen"), "--train-frames", "5", "--test-frames", "3", "--method", "forest,ferns,paper"],
    "rooms.kidnap.kitchen": ["kidnap", "--sequence", "synthetic:kitchen?frames=60&width=320&height=240", "--removed", "1", "--removed-length", "8", "--teleports", "1", "--judged", "8"],
    "rooms.scale": ["scale", "--rooms", "1,2", "--frames", "6", "--test-frames", "3", "--size", "160x120", "--settle", "2", "--method", "forest,ferns"],
    "rooms.trust": ["trust", "--rooms", "2", "--frames", "6", "--own", "4", "--strangers", "4", "--spoilt", "1", "--settle", "2"],
    "rooms.failures.wrong": ["failures", "--scene", FAILURES, "--settle", "2", "--count", "1", "--pictures", "rooms.failures.wrong"],
}
VOID_TAGS = {"meta", "img", "br"}


class PageReader(html.parser.HTMLParser):
    """Checks that tags match, and notes what a page refers to and draws."""

    def __init__(self):
        super().__init__()
        self.open_tags, self.references, self.ids, self.plots, self.text = [], [], [], [], []

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.references += [values[name] for name in ("src", "href") if name in values]
        self.ids += [values["id"]] if "id" in values else []
        if tag == "svg":
            self.plots.append(0)
        if tag in ("polyline", "circle", "rect", "polygon") and "svg" in self.open_tags:
            self.plots[-1] += 1
            for value in values.values():
                assert "nan" not in str(value).lower(), f"{tag}: {values}"
        if tag not in VOID_TAGS:
            self.open_tags.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        self.handle_endtag(tag)

    def handle_endtag(self, tag):
        assert self.open_tags and self.open_tags[-1] == tag, f"</{tag}> closes {self.open_tags[-1:]}"
        self.open_tags.pop()

    def handle_data(self, data):
        if "style" not in self.open_tags:
            self.text.append(data)


class ReportTest(app_support.AppTest):
    """Tiny results, made once for all tests."""

    made = None

    @classmethod
    def setUpClass(cls):
        if ReportTest.made is None:
            ReportTest.made = tempfile.TemporaryDirectory()
            ReportTest.results = pathlib.Path(cls.made.name) / "results"
            cls.results.mkdir()
            for name, arguments in EXPERIMENTS.items():
                result = subprocess.run([cls.app, *arguments, "--json", f"{name}.json"], cwd=cls.results, capture_output=True, text=True, check=False)
                assert result.returncode == 0, result.stderr

    def run_script(self, *command):
        return subprocess.run([str(part) for part in command], cwd=self.folder, capture_output=True, text=True, check=False)

    def make_page(self, results, *arguments):
        return self.run_script(sys.executable, "-B", SCRIPTS / "report", "--results", results, "--out", "report.html", *arguments)


class PageTest(ReportTest):
    def read_page(self):
        result = self.make_page(self.results, "--commit", "0123abc", "--accuracy", "accuracy.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        reader = PageReader()
        reader.feed((self.folder / "report.html").read_text())
        self.assertEqual(reader.open_tags, [])
        return reader

    def test_page_holds_every_section_and_needs_nothing_else(self):
        reader = self.read_page()
        self.assertEqual(reader.ids, ["adaptation", "loss", "novelty", "cost", "confidence", "kidnap", "scale", "trust", "failures", "reproduce"])
        for reference in reader.references:
            self.assertTrue(reference.startswith(("data:image/png;base64,", "#")), reference[:80])
        page = (self.folder / "report.html").read_text()
        for word in ["http://", "https://", "@import", "url("]:
            self.assertNotIn(word, page)
        self.assertIn("prefers-color-scheme", page)
        self.assertIn('name="viewport"', page)

    def test_no_plot_is_empty_and_no_number_is_missing(self):
        reader = self.read_page()
        self.assertGreater(len(reader.plots), 8)
        self.assertGreater(min(reader.plots), 0)
        for text in reader.text:
            self.assertNotIn(text.strip().lower(), ["nan", "none", "null", "inf"])

    def test_paper_stands_beside_ours(self):
        text = "".join(self.read_page().text)
        for number in ["141", "9.8", "84.6"]:
            self.assertIn(number, text)

    def test_accuracy_holds_no_times_and_is_repeated_by_another_run(self):
        self.read_page()
        first = json.loads((self.folder / "accuracy.json").read_text())
        again = self.folder / "again"
        again.mkdir()
        for name in ["rooms.adapt", "rooms.loss.kitchen", "rooms.time"]:
            arguments = [part for part in EXPERIMENTS[name] if not part.endswith(".csv") and part != "--csv"]
            subprocess.run([self.app, *arguments, "--json", f"{name}.json"], cwd=again, capture_output=True, check=True)
        self.assertEqual(self.make_page(again, "--accuracy", "accuracy.json").returncode, 0)
        second = json.loads((self.folder / "accuracy.json").read_text())
        for name, document in second.items():
            self.assertEqual(document, first[name])
            text = json.dumps(document).replace('"max_relocalise_ms"', "")  # a setting
            for word in ['_ms"', '"timing"', '"peak_mb"', '"machine"']:
                self.assertNotIn(word, text)

    def test_bad_results_are_explained(self):
        self.assertIn("no such folder", self.make_page("missing").stderr)
        (self.folder / "empty").mkdir()
        self.assertIn("holds no results", self.make_page("empty").stderr)
        (self.folder / "empty" / "rooms.adapt.json").write_text("{")
        self.assertIn("rooms.adapt.json: not JSON", self.make_page("empty").stderr)
        (self.folder / "empty" / "rooms.adapt.json").write_text('{"format": "other"}')
        result = self.make_page("empty")
        self.assertIn("foothold-benchmark", result.stderr)
        self.assertEqual(result.returncode, 2)
        self.assertFalse((self.folder / "report.html").exists())


STUB = """#!{python}
import json, pathlib, shutil, sys
arguments = sys.argv[1:]
program = pathlib.Path(sys.argv[0]).name
with open({log!r}, "a") as log:
    log.write(program + " " + " ".join(arguments) + "\\n")
def value(option):
    return arguments[arguments.index(option) + 1]
if program == "relocalisation_benchmark":
    stop = pathlib.Path({stop!r})
    if stop.exists() and arguments[0] == stop.read_text():
        sys.exit(130)
    kind = arguments[0]
    shutil.copy(next(pathlib.Path({results!r}).glob("rooms." + kind + "*.json")), value("--json"))
    if "--csv" in arguments:
        shutil.copy(next(pathlib.Path({results!r}).glob("rooms." + kind + "*.csv")), value("--csv"))
else:
    pathlib.Path(value("--out")).mkdir() if program == "render_sequence" else pathlib.Path(value("--out")).touch()
"""


class ScriptTest(ReportTest):
    """report.sh with stand-ins for the programs, which note how they are called."""

    def setUp(self):
        super().setUp()
        self.log = self.folder / "calls.log"
        self.stop = self.folder / "stop"
        bin_folder = self.folder / "bin"
        bin_folder.mkdir()
        for name in ["relocalisation_benchmark", "render_sequence", "train_forest"]:
            (bin_folder / name).write_text(STUB.format(python=sys.executable, log=str(self.log), stop=str(self.stop), results=str(self.results)))
            (bin_folder / name).chmod(0o755)

    def report(self, *arguments):
        self.log.write_text("")
        result = self.run_script("bash", SCRIPTS / "report.sh", "--quick", "--out", "out", "--bin", "bin", *arguments)
        return result, self.log.read_text().splitlines()

    def test_runs_everything_once_and_keeps_it(self):
        result, calls = self.report()
        self.assertEqual(result.returncode, 0, result.stderr)
        for kind in ["adapt", "loss", "novel", "confidence", "time", "failures", "kidnap", "scale", "trust"]:
            self.assertTrue(any(call.startswith(f"relocalisation_benchmark {kind}") for call in calls), kind)
        self.assertTrue((self.folder / "out" / "report.html").exists())
        result, calls = self.report()
        self.assertEqual((result.returncode, calls), (0, []))
        self.assertIn("kept from before", result.stderr)

    def test_other_options_run_again_what_they_change(self):
        self.report()
        _, calls = self.report("--seed", "7")
        self.assertFalse([call for call in calls if call.startswith("render_sequence")])
        self.assertTrue(all("--seed 7" in call for call in calls))
        self.assertTrue(calls)

    def test_an_interrupted_report_goes_on_where_it_stopped(self):
        self.stop.write_text("confidence")
        result, calls = self.report()
        self.assertEqual(result.returncode, 130)
        self.assertIn("run it again to go on", result.stderr)
        self.assertFalse((self.folder / "out" / "report.html").exists())
        self.stop.unlink()
        result, calls = self.report()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(calls[0].startswith("relocalisation_benchmark confidence"), calls[0])

    def test_wrong_arguments(self):
        (self.folder / "none").mkdir()
        for arguments, says in [(["--fast"], "--fast"), (["--seed"], "expected a value"), (["--recording", "desk"], "NAME=SEQUENCE"),
                                (["--bin", "none"], "not found"), (["--seven-scenes", "none"], "holds none of chess"), (["--recording", "desk=none"], "0 frames")]:
            result, _ = self.report(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn(says, result.stderr)

    def test_recordings_are_halved_both_ways(self):
        app_support.write_seven_scenes(self.folder / "desk", 6)
        _, calls = self.report("--recording", "desk=desk")
        adapt = [call for call in calls if call.startswith("relocalisation_benchmark adapt") and "desk-forth=" in call]
        self.assertEqual(len(adapt), 1)
        self.assertIn("desk@0:3,", adapt[0])
        self.assertIn("desk@3:6,", adapt[0])


class ReadmeTest(ReportTest):
    @staticmethod
    def markers(name):
        return f"<!-- results {name}: written by scripts/readme_tables.py, do not edit -->", f"<!-- results {name}: end -->"

    def tables(self, *arguments):
        return self.run_script(sys.executable, "-B", SCRIPTS / "readme_tables.py", *arguments)

    def setUp(self):
        super().setUp()
        self.readme = self.folder / "README.md"
        self.page = self.folder / "results.md"
        self.readme.write_text("\n".join(["Above", *self.markers("recordings"), "Below\n"]))
        self.page.write_text("\n".join(["Above", *self.markers("rooms"), "Below\n"]))

    def write(self):
        result = self.tables("write", self.results, self.readme, self.page, "--commit", "0123abc")
        self.assertEqual(result.returncode, 0, result.stderr)
        return self.readme.read_text(), self.page.read_text()

    def test_written_tables_pass_their_check(self):
        texts = self.write()
        for text in texts:
            self.assertTrue(text.startswith("Above\n") and text.endswith("Below\n"))
            self.assertIn("Commit 0123abc, ", text)
        self.assertIn("| desk, 30 frames ahead | forest |", texts[0])
        self.assertIn("| data-free | forest |", texts[1])
        self.assertEqual(self.tables("check", self.readme, self.page).returncode, 0)
        self.assertEqual(self.write(), texts, "writing twice changes nothing")

    def test_both_tables_may_stand_in_one_document(self):
        self.readme.write_text("\n".join([*self.markers("rooms"), *self.markers("recordings")]))
        self.assertEqual(self.tables("write", self.results, self.readme, "--commit", "0123abc").returncode, 0)
        self.assertEqual(self.tables("check", self.readme).returncode, 0)

    def test_stale_forms_are_found(self):
        texts = dict(zip((self.readme, self.page), self.write()))
        stale = [(path, *change) for path, name in ((self.readme, "recordings"), (self.page, "rooms"))
                 for change in ((self.markers(name)[0], "", "expected one line"), (self.markers(name)[1], "", "expected one line"),
                                ("Commit 0123abc", "Commit of today", "stamp"))]
        stale += [(self.readme, "| found % |", "| recall |", "columns"), (self.page, "| average |", "| mean |", "columns"),
                  (self.readme, "| desk | forest |", "| desk |", "different length")]
        for path, old, new, says in stale:
            path.write_text(texts[path].replace(old, new, 1))
            result = self.tables("check", self.readme, self.page)
            self.assertEqual(result.returncode, 1, old)
            self.assertIn(says, result.stdout)
            path.write_text(texts[path])

    def test_a_table_that_no_document_or_two_have_is_found(self):
        self.write()
        self.assertIn("0 have it", self.tables("check", self.readme).stdout)
        self.assertIn("2 have it", self.tables("check", self.readme, self.page, shutil.copy(self.page, self.folder / "copy.md")).stdout)

    def test_tables_name_neither_host_nor_path(self):
        for text in self.write():
            self.assertNotIn(os.uname().nodename, text)
            self.assertNotIn(str(self.folder), text)

    def test_nothing_is_written_without_the_results_or_markers(self):
        shutil.copytree(self.results, self.folder / "some")
        (self.folder / "some" / "rooms.adapt.json").unlink()
        before = self.readme.read_text(), self.page.read_text()
        result = self.tables("write", "some", self.readme, self.page, "--commit", "0123abc")
        self.assertEqual(result.returncode, 2)
        self.assertIn("rooms.adapt", result.stderr)
        self.assertEqual((self.readme.read_text(), self.page.read_text()), before)
        self.page.write_text("no markers")
        self.assertEqual(self.tables("write", self.results, self.readme, self.page, "--commit", "0123abc").returncode, 2)
        self.assertEqual(self.readme.read_text(), before[0])


if __name__ == "__main__":
    app_support.main()
