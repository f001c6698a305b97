"""A program's window on an X server, as a user has it: its picture, its size, keys. By libX11 alone."""
import ctypes
import ctypes.util
import subprocess
import time

import numpy

KEY_PRESS, KEY_RELEASE, VIEWABLE, Z_PIXMAP = 2, 3, 2, 2
KEYS = {"space": 0x20, "Escape": 0xFF1B}
PATIENCE = 120  # seconds: compiling shaders takes some


class Attributes(ctypes.Structure):
    """XWindowAttributes as far as it is read."""

    _fields_ = [(name, ctypes.c_int) for name in ("x", "y", "width", "height", "border_width", "depth")] + [
        ("visual", ctypes.c_void_p), ("root", ctypes.c_ulong), ("class_", ctypes.c_int), ("bit_gravity", ctypes.c_int),
        ("win_gravity", ctypes.c_int), ("backing_store", ctypes.c_int), ("backing_planes", ctypes.c_ulong),
        ("backing_pixel", ctypes.c_ulong), ("save_under", ctypes.c_int), ("colormap", ctypes.c_ulong),
        ("map_installed", ctypes.c_int), ("map_state", ctypes.c_int), ("rest", ctypes.c_byte * 64)]


class Image(ctypes.Structure):
    """XImage as far as it is read."""

    _fields_ = [("width", ctypes.c_int), ("height", ctypes.c_int), ("xoffset", ctypes.c_int), ("format", ctypes.c_int),
                ("data", ctypes.POINTER(ctypes.c_ubyte)), ("byte_order", ctypes.c_int), ("bitmap_unit", ctypes.c_int),
                ("bitmap_bit_order", ctypes.c_int), ("bitmap_pad", ctypes.c_int), ("depth", ctypes.c_int),
                ("bytes_per_line", ctypes.c_int), ("bits_per_pixel", ctypes.c_int)]


class KeyEvent(ctypes.Structure):
    """XKeyEvent, padded to an XEvent."""

    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", ctypes.c_ulong), ("root", ctypes.c_ulong), ("subwindow", ctypes.c_ulong), ("time", ctypes.c_ulong),
                ("x", ctypes.c_int), ("y", ctypes.c_int), ("x_root", ctypes.c_int), ("y_root", ctypes.c_int),
                ("state", ctypes.c_uint), ("keycode", ctypes.c_uint), ("same_screen", ctypes.c_int), ("rest", ctypes.c_byte * 128)]


def library():
    x11 = ctypes.CDLL(ctypes.util.find_library("X11"))
    x11.XOpenDisplay.restype = x11.XDefaultRootWindow.restype = ctypes.c_void_p
    x11.XGetImage.restype = ctypes.POINTER(Image)
    x11.XGetImage.argtypes = [ctypes.c_void_p, ctypes.c_ulong] + [ctypes.c_int] * 2 + [ctypes.c_uint] * 2 + [ctypes.c_ulong, ctypes.c_int]
    x11.XDestroyWindow.argtypes = x11.XDefaultRootWindow.argtypes = [ctypes.c_void_p]
    return x11


class Window:
    """Starts a program and waits for its window; a context that ends both."""

    def __init__(self, command, title, errors=None):
        self.x11 = library()
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(None))
        assert self.display, "no X server"
        self.root = ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display))
        self.process = subprocess.Popen(command, stderr=errors)
        self.window = self.wait("window", lambda: self.find(title))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()

    def wait(self, what, condition):
        """What the condition gives, once that is true."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            result = condition()
            if result:
                return result
            assert self.process.poll() is None, f"waiting for {what}: the program has ended, with {self.process.returncode}"
            time.sleep(0.05)
        raise AssertionError(f"no {what} after {PATIENCE} s")

    def find(self, title):
        root, parent = ctypes.c_ulong(), ctypes.c_ulong()
        children, count = ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
        self.x11.XQueryTree(self.display, self.root, *map(ctypes.byref, (root, parent, children, count)))
        for child in children[:count.value]:
            name = ctypes.c_char_p()
            self.x11.XFetchName(self.display, ctypes.c_ulong(child), ctypes.byref(name))
            if name.value == title.encode() and self.attributes(child).map_state == VIEWABLE:
                return child
        return None

    def attributes(self, window):
        attributes = Attributes()
        self.x11.XGetWindowAttributes(self.display, ctypes.c_ulong(window), ctypes.byref(attributes))
        return attributes

    def picture(self):
        """Rows from the top, RGB, 0 to 1."""
        size = self.attributes(self.window)
        image = self.x11.XGetImage(self.display, self.window, 0, 0, size.width, size.height, 0xFFFFFFFF, Z_PIXMAP).contents
        assert image.bits_per_pixel == 32
        rows = numpy.ctypeslib.as_array(image.data, (image.height, image.bytes_per_line)).copy()
        return rows.reshape(image.height, -1, 4)[:, :image.width, 2::-1] / 255

    def resize(self, width, height):
        self.x11.XResizeWindow(self.display, ctypes.c_ulong(self.window), width, height)
        self.x11.XSync(self.display, 0)

    def key(self, name, pressed):
        code = self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(KEYS[name]))
        event = KeyEvent(type=KEY_PRESS if pressed else KEY_RELEASE, window=self.window, root=self.root, keycode=code, same_screen=1)
        self.x11.XSendEvent(self.display, ctypes.c_ulong(self.window), 1, ctypes.c_long(1 if pressed else 2), ctypes.byref(event))
        self.x11.XSync(self.display, 0)

    def exit_status(self):
        return self.process.wait(PATIENCE)
