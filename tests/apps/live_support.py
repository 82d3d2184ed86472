# SPDX-License-Identifier: MIT
# Copyright (c) 2026 The Foothold authors
"""The virtual camera on the real OpenNI2 library, a rendered room to show to it, and a screen to look at."""

import ctypes
import hashlib
import math
import os
import pathlib
import shutil
import signal
import subprocess
import threading
import time

import app_support

PATIENCE_S = 240  # for machines that are busy with other things; nothing here asserts speed


class LiveTest(app_support.AppTest):
    """A test of an app that reads a camera; a small one with a pattern is plugged in."""

    def setUp(self):
        super().setUp()
        library = pathlib.Path(self.app).parent.parent / "virtual_camera"
        self.assertTrue((library / "libOpenNI2.so.0").exists(), "the virtual camera is not built")
        self.set_variable("LD_LIBRARY_PATH", str(library))
        self.set_variable("DISPLAY", "")
        self.set_variable("WAYLAND_DISPLAY", "")
        self.plug_in("pattern:160x120")

    def set_variable(self, name, value):
        before = os.environ.get(name)
        self.addCleanup(os.environ.__setitem__, name, before) if before is not None else self.addCleanup(os.environ.pop, name, None)
        os.environ[name] = value

    def plug_in(self, sequence, **script):
        self.set_variable("FOOTHOLD_VIRTUAL_CAMERA", str(sequence))
        for name, value in script.items():
            self.set_variable(f"FOOTHOLD_VIRTUAL_CAMERA_{name}", str(value))

    def recorded(self, folder):
        return len(list((self.folder / folder).glob("frame-*.depth.png")))

    def start(self, *arguments):
        """Starts the app; ends it with the test at the latest."""
        process = subprocess.Popen(
            [self.app, *map(str, arguments)], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_DFL),  # the tests themselves may run under nohup
        )  # fmt: skip

        def end():
            if process.poll() is None:
                process.kill()
            process.communicate()

        self.addCleanup(end)
        return process

    def wait_for_line(self, process, words):
        """Waits until the app has said something on stderr."""
        said = ""
        timer = threading.Timer(PATIENCE_S, process.kill)
        timer.start()
        self.addCleanup(timer.cancel)
        for line in process.stderr:
            said += line
            if words in line:
                timer.cancel()
                return
        self.fail(f"the app ended without saying '{words}': {said}")

    def wait_for(self, condition, process=None, what="what was waited for"):
        start = time.monotonic()
        while time.monotonic() - start < PATIENCE_S:
            result = condition()
            if result:
                return result
            if process is not None:
                self.assertIsNone(process.poll(), "the app ended by itself")
            time.sleep(0.05)
        self.fail(f"{what} did not come")
        return None


def read_transform(path):
    numbers = [float(word) for word in path.read_text().split()]
    return [numbers[0:4], numbers[4:8], numbers[8:12]]


def inverse(m):
    turned = [[m[j][i] for j in range(3)] for i in range(3)]
    return [row + [-sum(row[k] * m[k][3] for k in range(3))] for row in turned]


def apply(m, point):
    return [sum(m[i][k] * point[k] for k in range(3)) + m[i][3] for i in range(3)]


def read_trajectory(path):
    """Positions by their time, as written."""
    lines = [line.split() for line in path.read_text().splitlines() if not line.startswith("#")]
    return {words[0]: [float(word) for word in words[1:4]] for words in lines}


class Room:
    """A rendered room in a folder: what the virtual camera shows, and where it truly was."""

    def __init__(self, folder, app_folder, spec):
        self.folder = folder
        subprocess.run([app_folder / "render_sequence", "--sequence", spec, "--out", folder], check=True, capture_output=True)
        self.index_of = {self.digest(path): int(path.name[6:12]) for path in folder.glob("frame-*.color.png")}

    @staticmethod
    def digest(path):
        return hashlib.sha256(path.read_bytes()).hexdigest()

    def true_position(self, index):
        pose = read_transform(self.folder / f"frame-{index:06d}.pose.txt")
        return [row[3] for row in pose]

    def errors(self, recording, trajectory, origin=None):
        """For each recorded frame: the room's frame that it shows, None if the lens was covered, and the distance [m] of its pose to the
        truth, None without a pose, infinite for the pose of a covered camera.

        The trajectory's world is that of the room's frame `origin`, by default the first one recorded. A recording holds the camera's images
        bit by bit, so that they tell which frames they are.
        """
        times = [line.split()[1] for line in (recording / "timestamps.txt").read_text().splitlines()]
        indices = [self.index_of.get(self.digest(recording / f"frame-{i:06d}.color.png")) for i in range(len(times))]
        found = read_trajectory(trajectory)
        to_world = inverse(read_transform(self.folder / f"frame-{indices[0] if origin is None else origin:06d}.pose.txt"))
        errors = []
        for stamp, index in zip(times, indices):
            truth = [math.inf] * 3 if index is None else apply(to_world, self.true_position(index))
            errors.append((index, math.dist(truth, found[stamp]) if stamp in found else None))
        return errors


class Screen:
    """An X server without hardware, and the hands and eyes of somebody who sits before it."""

    @staticmethod
    def missing():
        if shutil.which("Xvfb") is None:
            return "Xvfb is missing; scripts/install_packages.sh installs it"
        try:
            ctypes.CDLL("libX11.so.6")
        except OSError:
            return "libX11 is missing"
        return None

    def __init__(self):
        reader, writer = os.pipe()
        command = ["Xvfb", "-displayfd", str(writer), "-screen", "0", "1400x800x24", "-nolisten", "tcp"]
        self.server = subprocess.Popen(command, pass_fds=[writer], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as stream:
            number = stream.readline().strip()
        if not number:
            self.server.kill()
            raise RuntimeError("Xvfb does not start")
        self.name = f":{number}"
        self.x11 = ctypes.CDLL("libX11.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.x11.XDefaultRootWindow.restype = ctypes.c_ulong
        self.x11.XGetImage.restype = ctypes.c_void_p
        self.x11.XGetPixel.restype = ctypes.c_ulong
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(self.name.encode()))
        self.root = ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display))

    def close(self):
        self.x11.XCloseDisplay(self.display)
        self.server.terminate()
        self.server.wait()

    def find_window(self, title, window=None):
        """The window of a title, or None."""
        window = self.root if window is None else window
        name = ctypes.c_char_p()
        if self.x11.XFetchName(self.display, window, ctypes.byref(name)) and name.value == title.encode():
            return window
        root, parent, children, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        if not self.x11.XQueryTree(
            self.display, window, ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children), ctypes.byref(count)
        ):
            return None
        found = [self.find_window(title, ctypes.c_ulong(children[i])) for i in range(count.value)]
        return next((child for child in found if child is not None), None)

    def num_colours(self):
        """How many different colours the screen shows on a grid of points."""
        all_planes, z_pixmap = ctypes.c_ulong(0xFFFFFF), 2
        image = ctypes.c_void_p(self.x11.XGetImage(self.display, self.root, 0, 0, 1280, 720, all_planes, z_pixmap))
        return len({self.x11.XGetPixel(image, x, y) for x in range(0, 1280, 20) for y in range(0, 720, 20)})

    def press(self, window, key):
        """Presses and releases a key in a window."""

        class KeyEvent(ctypes.Structure):
            _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p)]
            _fields_ += [(name, ctypes.c_ulong) for name in ["window", "root", "subwindow", "time"]]
            _fields_ += [(name, ctypes.c_int) for name in ["x", "y", "x_root", "y_root"]]
            _fields_ += [("state", ctypes.c_uint), ("keycode", ctypes.c_uint), ("same_screen", ctypes.c_int), ("room", ctypes.c_long * 24)]

        code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(ord(key)))
        for kind, mask in [(2, 1), (3, 2)]:  # KeyPress, KeyRelease
            event = KeyEvent(type=kind, display=self.display, window=window.value, root=self.root.value, keycode=code, same_screen=1)
            self.x11.XSendEvent(self.display, window, 1, ctypes.c_long(mask), ctypes.byref(event))
        self.x11.XFlush(self.display)
