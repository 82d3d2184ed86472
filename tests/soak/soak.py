# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""Runs a camera and the library for hours, and fails unless what they take stays flat. scripts/soak.sh calls it.

Two loops run side by side:

- camera: reconstruct_live on the virtual camera in a rendered room, with kidnaps, a covered lens, stalls and unplugging; in each cycle
  the camera finds itself in the scene that was loaded, tracking is made to fail, all is forgotten and learnt anew, the scene and the
  surface are saved, and the scene is loaded again. So no cycle holds more than the one before: what grows is a leak.
- library: soak_library, a plain wall with counters near their limits.

Memory, file handles and threads are read from /proc once a cycle, and the processor time of its frames. Of the second half of a run, the
growth along the line of least squares, less twice its standard error, must stay within GROWTH: cycles differ.
"""

import argparse
import math
import os
import pathlib
import subprocess
import sys
import threading
import time

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPOSITORY / "scripts" / "report"))
sys.dont_write_bytecode = True

import charts  # noqa: E402

# Quantity: unit, and how much it may grow in the second half of a run: a number, and a share of its median.
GROWTH = {
    "memory": ("MB", 8.0, 0.02),
    "file handles": ("", 0.9, 0.0),
    "threads": ("", 0.9, 0.0),
    "processor time": ("ms/frame", 0.02, 0.25),
}
STANDARD_ERRORS = 2.0
FPS = 10
ROOM = "synthetic:kitchen?frames=110&width=320&height=240"
SMALL_ROOM = "synthetic:kitchen?frames=40&width=160&height=120"
MAX_RUN_S = 3600  # of one camera process; the next goes on with its scene
WARM_UP_S = 300  # shorter runs still fill their buffers and map: only what has no warm-up is judged
KILL_AFTER_S = 480  # what a run may take beyond its time: instrumented programs on busy machines are slow


class Watch:
    """What a process takes, from cycle to cycle."""

    def __init__(self, process):
        self.process = process
        self.begin = time.monotonic()
        self.samples = []  # (s, {quantity: value})
        self.cpu_ms, self.frames = 0.0, 0

    def sample(self, frames):
        """Call at the end of a cycle, with the number of frames so far."""
        proc = pathlib.Path("/proc") / str(self.process.pid)
        try:
            words = (proc / "stat").read_text().rsplit(")", 1)[1].split()
            pages = int((proc / "statm").read_text().split()[1])
            handles = len(os.listdir(proc / "fd"))
        except (FileNotFoundError, ProcessLookupError):
            return  # it has ended meanwhile
        cpu_ms = 1000.0 * (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")
        values = {
            "memory": 1e-6 * pages * os.sysconf("SC_PAGE_SIZE"),
            "file handles": handles,
            "threads": int(words[17]),
            "processor time": (cpu_ms - self.cpu_ms) / max(1, frames - self.frames),
        }
        self.cpu_ms, self.frames = cpu_ms, frames
        self.samples.append((time.monotonic() - self.begin, values))


def growth(points):
    """Along the line of least squares, from the first point to the last; and its standard error."""
    if len(points) < 3:
        return 0.0, 0.0
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    if spread == 0:
        return 0.0, 0.0
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread
    scatter = sum((y - mean_y - slope * (x - mean_x)) ** 2 for x, y in points) / (len(points) - 2)
    seconds = points[-1][0] - points[0][0]
    return slope * seconds, math.sqrt(scatter / spread) * seconds


def judge(samples):
    """(quantity, median, growth in the second half, its standard error, allowed) of a run."""
    is_warm = samples[-1][0] >= WARM_UP_S
    second_half = samples[len(samples) // 2 :]
    rows = []
    for quantity, (_, absolute, share) in GROWTH.items():
        points = [(seconds, values[quantity]) for seconds, values in second_half]
        median = sorted(y for _, y in points)[len(points) // 2]
        allowed = absolute + share * median if is_warm or share == 0.0 else math.inf
        rows.append((quantity, median, *growth(points), allowed))
    return rows


class Run:
    """One process from its start to its end."""

    def __init__(self, name, command, environment, log):
        self.name = name
        self.errors = []
        self.log = open(log, "w", encoding="utf-8")
        self.process = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.watch = Watch(self.process)

    def follow(self, frames_of_line, limit_s):
        """Samples where `frames_of_line` finds the end of a cycle in a line of the log."""
        timer = threading.Timer(limit_s, self.process.kill)
        timer.start()
        for line in self.process.stdout:
            self.log.write(line)
            frames = frames_of_line(line)
            if frames is not None:
                self.watch.sample(frames)
        status = self.process.wait()
        timer.cancel()
        self.log.close()
        if status != 0:
            self.errors.append(f"exit status {status}, see {self.log.name}")
        if len(self.watch.samples) < 2:
            self.errors.append(f"only {len(self.watch.samples)} cycles")
            return
        for quantity, median, grown, error, allowed in judge(self.watch.samples):
            if grown - STANDARD_ERRORS * error > allowed:
                self.errors.append(f"{quantity} grew by {grown:.3g} +- {error:.3g} from about {median:.4g}, allowed {allowed:.3g}")


class CameraLoop:
    """reconstruct_live, run after run."""

    def __init__(self, arguments):
        self.bin, self.out = arguments.bin, arguments.out
        self.seconds = arguments.hours * 3600.0
        self.small = arguments.hours == 0
        self.cycle = 25 if self.small else 300  # frames
        self.num_cycles = 4 if self.small else 0
        self.runs = []

    def room(self):
        folder = self.out / ("small_room" if self.small else "room")
        if not folder.exists():
            spec = SMALL_ROOM if self.small else ROOM
            subprocess.run([self.bin / "render_sequence", "--sequence", spec, "--out", folder], check=True, capture_output=True)
        return folder

    def script(self, num_cycles):
        """Events of the camera's clock, and keys pressed, cycle by cycle."""
        part = self.cycle // 5
        events, keys = [], []
        for begin in range(0, num_cycles * self.cycle, self.cycle):
            events += [f"unplug@{begin + part}+{part // 3}", f"cover@{begin + 2 * part}+4", f"jump@{begin + 2 * part + 3}=15"]
            events += [f"stall@{begin + 3 * part}+2", f"freeze@{begin + 4 * part}+{part // 3}"]
            keys += [f"l@{begin + part // 2}", f"r@{begin + part - 1}", f"m@{begin + 4 * part}"]
            keys += [f"s@{begin + self.cycle - 2}", f"o@{begin + self.cycle - 1}"]
        return events, [word for key in keys for word in ("--press", key)]

    def run(self):
        room = self.room()
        size = "160x120" if self.small else "320x240"
        scene = self.out / "soak.scene"
        scene.unlink(missing_ok=True)
        left_s = self.seconds
        while left_s > 0 or not self.runs:
            run_s = min(left_s, MAX_RUN_S)
            num_cycles = self.num_cycles or int(run_s * FPS / self.cycle) + 1
            events, keys = self.script(num_cycles)
            command = [self.bin / "reconstruct_live", "--mode", f"{size}@{FPS}", "--headless", "--save-scene", scene]
            command += ["--save-mesh", self.out / "soak.ply", "--set", "camera.silence_timeout_ms=1000", *keys]
            command += ["--duration", f"{run_s:.0f}"] if run_s > 0 else ["--frames", str(num_cycles * self.cycle)]
            if scene.exists():
                command += ["--load-scene", scene]
            environment = {
                **os.environ, "LD_LIBRARY_PATH": str(self.bin.parent / "virtual_camera"), "FOOTHOLD_VIRTUAL_CAMERA": str(room),
                "FOOTHOLD_VIRTUAL_CAMERA_FPS": str(FPS), "FOOTHOLD_VIRTUAL_CAMERA_AT_END": "pingpong",
                "FOOTHOLD_VIRTUAL_CAMERA_EVENTS": ",".join(events),
                "MALLOC_ARENA_MAX": "1",  # or what threads have freed stays with them, and memory differs from cycle to cycle
            }  # fmt: skip
            run = Run("camera", list(map(str, command)), environment, self.out / f"camera{len(self.runs)}.log")
            self.runs.append(run)
            cycles = iter(range(1, num_cycles + 1))

            def frames_of_line(line, cycles=cycles):
                return next(cycles, num_cycles) * self.cycle if "going on with the scene" in line and "--load" not in line else None

            run.follow(frames_of_line, run_s + KILL_AFTER_S)
            left_s -= max(run_s, 1)


class LibraryLoop:
    """soak_library, once."""

    def __init__(self, arguments):
        self.bin, self.out = arguments.bin, arguments.out
        self.seconds = arguments.hours * 3600.0
        self.frames = 2000 if arguments.hours == 0 else 334000  # from each of three starts
        self.runs = []

    def run(self):
        command = [str(self.bin / "soak_library"), str(self.frames), f"{self.seconds:.0f}"]
        run = Run("library", command, None, self.out / "library.log")
        self.runs.append(run)

        def frames_of_line(line):
            return int(line.split()[1]) if line.startswith("frames ") else None

        limit_s = 3 * max(self.seconds, 600) + KILL_AFTER_S  # a pass of all starts is finished, however late it began
        run.follow(frames_of_line, limit_s)


def picture(run, quantity):
    points = [(seconds / 60.0, values[quantity]) for seconds, values in run.watch.samples]
    high = 1.1 * max(y for _, y in points)
    chart = charts.Chart(charts.Axis(0.0, max(points[-1][0], 1e-3)), charts.Axis(0.0, max(high, 1.0)), label=f"{run.name}: {quantity}")
    chart.draw_axes(x_title="min")
    chart.line(points, "s-forest")
    unit = GROWTH[quantity][0]
    return charts.figure(chart.svg(), title=f"{run.name}: {quantity}{f' [{unit}]' if unit else ''}")


def write_report(runs, path):
    """Tables on the terminal, and the same with pictures as one page."""
    rows = []
    columns = ["run", "minutes", "quantity", "median", "growth in the second half", "standard error", "allowed", ""]
    print("\n| " + " | ".join(columns) + " |\n|---|---:|---|---:|---:|---:|---:|---|")
    for run in runs:
        if len(run.watch.samples) < 2:
            continue
        minutes = run.watch.samples[-1][0] / 60.0
        for quantity, median, grown, error, allowed in judge(run.watch.samples):
            is_flat = grown - STANDARD_ERRORS * error <= allowed
            verdict = "too short to tell" if math.isinf(allowed) else "flat" if is_flat else "GROWS"
            cells = [run.name, f"{minutes:.1f}", quantity, f"{median:.4g}", f"{grown:.3g}", f"{error:.3g}", f"{allowed:.3g}", verdict]
            print("| " + " | ".join(cells) + " |")
            rows.append(cells)
    style = (REPOSITORY / "scripts" / "report" / "style.css").read_text(encoding="utf-8")
    pictures = "".join(picture(run, quantity) for run in runs if len(run.watch.samples) >= 2 for quantity in GROWTH)
    table = charts.table(columns, rows)
    page = f'<!doctype html><meta charset="utf-8"><title>Soak</title><style>{style}</style><main><h1>Soak</h1>{table}'
    path.write_text(f'{page}<div class="grid2">{pictures}</div></main>', encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--hours", type=float, required=True, help="0 for a few cycles, as a test")
    parser.add_argument("--bin", type=pathlib.Path, required=True, help="where reconstruct_live, render_sequence and soak_library are")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="folder for the report, logs and scenes")
    arguments = parser.parse_args()
    arguments.bin, arguments.out = arguments.bin.resolve(), arguments.out.resolve()
    arguments.out.mkdir(parents=True, exist_ok=True)
    loops = [CameraLoop(arguments), LibraryLoop(arguments)]
    threads = [threading.Thread(target=loop.run) for loop in loops]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    runs = [run for loop in loops for run in loop.runs]
    write_report(runs, arguments.out / "soak.html")
    errors = [f"{run.name}: {error}" for run in runs for error in run.errors]
    errors += [f"{type(loop).__name__} did not run" for loop in loops if not loop.runs]
    for error in errors:
        print(f"soak: {error}", file=sys.stderr)
    print(f"report: {arguments.out / 'soak.html'}")
    return 1 if errors else 0


if __name__ == "__main__":
    sys.exit(main())
