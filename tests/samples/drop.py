"""Drops a file onto a window, as a file manager does (XDND, version 5). By libX11 alone."""
import ctypes
import time

from window import library

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31
PATIENCE = 10  # seconds


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", ctypes.c_ulong), ("message", ctypes.c_ulong), ("format", ctypes.c_int), ("data", ctypes.c_long * 5),
                ("rest", ctypes.c_byte * 128)]


class SelectionRequest(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("owner", ctypes.c_ulong), ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong),
                ("property", ctypes.c_ulong), ("time", ctypes.c_ulong), ("rest", ctypes.c_byte * 128)]


class SelectionNotify(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("requestor", ctypes.c_ulong), ("selection", ctypes.c_ulong), ("target", ctypes.c_ulong),
                ("property", ctypes.c_ulong), ("time", ctypes.c_ulong), ("rest", ctypes.c_byte * 128)]


def drop(target, file, x, y):
    """The file is dropped at a place of the window, in pixels of the screen; returns once it was taken."""
    x11 = library()
    x11.XCreateSimpleWindow.restype = x11.XInternAtom.restype = ctypes.c_ulong
    display = ctypes.c_void_p(x11.XOpenDisplay(None))
    root = ctypes.c_ulong(x11.XDefaultRootWindow(display))
    source = ctypes.c_ulong(x11.XCreateSimpleWindow(display, root, 0, 0, 1, 1, 0, ctypes.c_ulong(0), ctypes.c_ulong(0)))
    atom = {name: x11.XInternAtom(display, name.encode(), 0) for name in (
        "XdndSelection", "XdndEnter", "XdndPosition", "XdndDrop", "XdndStatus", "XdndFinished", "XdndActionCopy", "text/uri-list")}
    x11.XSetSelectionOwner(display, ctypes.c_ulong(atom["XdndSelection"]), source, ctypes.c_ulong(0))

    def send(name, *data):
        message = ClientMessage(type=CLIENT_MESSAGE, window=target, message=atom[name], format=32)
        message.data[:] = [source.value, *data] + [0] * (4 - len(data))
        x11.XSendEvent(display, ctypes.c_ulong(target), 0, ctypes.c_long(0), ctypes.byref(message))
        x11.XFlush(display)

    def answer(request):
        data = f"file://{file}\r\n".encode()
        x11.XChangeProperty(display, ctypes.c_ulong(request.requestor), ctypes.c_ulong(request.property), ctypes.c_ulong(request.target),
                            8, 0, data, len(data))
        notify = SelectionNotify(type=SELECTION_NOTIFY, requestor=request.requestor, selection=request.selection,
                                 target=request.target, property=request.property, time=request.time)
        x11.XSendEvent(display, ctypes.c_ulong(request.requestor), 0, ctypes.c_long(0), ctypes.byref(notify))
        x11.XFlush(display)

    def wait_for(name):
        end = time.monotonic() + PATIENCE
        event = SelectionRequest()
        while time.monotonic() < end:
            if not x11.XPending(display):
                time.sleep(0.01)
                continue
            x11.XNextEvent(display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                answer(event)
            elif event.type == CLIENT_MESSAGE and ctypes.cast(ctypes.byref(event), ctypes.POINTER(ClientMessage)).contents.message == atom[name]:
                return
        raise AssertionError(f"no {name} after {PATIENCE} s")

    send("XdndEnter", 5 << 24, atom["text/uri-list"])
    send("XdndPosition", 0, x << 16 | y, 0, atom["XdndActionCopy"])
    wait_for("XdndStatus")
    send("XdndDrop", 0, 0)
    wait_for("XdndFinished")
    x11.XDestroyWindow(display, source)
    x11.XCloseDisplay(display)
