"""Drops files onto a window, as file managers do: version 5 of the XDND protocol, by libX11.

usage: dnd.py FILE ...      onto the window below the cursor of $DISPLAY
"""
import ctypes
import os
import pathlib
import sys
import time

X = ctypes.CDLL("libX11.so.6")
Window = Atom = ctypes.c_ulong


class ClientMessage(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", Window), ("message_type", Atom), ("format", ctypes.c_int), ("data", ctypes.c_long * 5)]


class SelectionRequest(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("owner", Window), ("requestor", Window), ("selection", Atom), ("target", Atom), ("property", Atom),
                ("time", ctypes.c_ulong)]


class SelectionNotify(ctypes.Structure):
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("requestor", Window), ("selection", Atom), ("target", Atom), ("property", Atom), ("time", ctypes.c_ulong)]


class Event(ctypes.Union):
    _fields_ = [("type", ctypes.c_int), ("client", ClientMessage), ("request", SelectionRequest), ("notify", SelectionNotify),
                ("pad", ctypes.c_long * 24)]


X.XOpenDisplay.restype = ctypes.c_void_p
X.XInternAtom.restype = Atom
X.XInternAtom.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
X.XDefaultRootWindow.restype = Window
X.XDefaultRootWindow.argtypes = [ctypes.c_void_p]
X.XCreateSimpleWindow.restype = Window
X.XCreateSimpleWindow.argtypes = [ctypes.c_void_p, Window] + [ctypes.c_int] * 2 + [ctypes.c_uint] * 3 + [ctypes.c_ulong] * 2
X.XSetSelectionOwner.argtypes = [ctypes.c_void_p, Atom, Window, ctypes.c_ulong]
X.XSendEvent.argtypes = [ctypes.c_void_p, Window, ctypes.c_int, ctypes.c_long, ctypes.POINTER(Event)]
X.XChangeProperty.argtypes = [ctypes.c_void_p, Window, Atom, Atom, ctypes.c_int, ctypes.c_int, ctypes.c_char_p, ctypes.c_int]
X.XNextEvent.argtypes = [ctypes.c_void_p, ctypes.POINTER(Event)]
X.XPending.argtypes = [ctypes.c_void_p]
X.XFlush.argtypes = [ctypes.c_void_p]
X.XQueryPointer.argtypes = [ctypes.c_void_p, Window] + [ctypes.c_void_p] * 7

CLIENT_MESSAGE, SELECTION_REQUEST, SELECTION_NOTIFY = 33, 30, 31


class Source:
    def __init__(self):
        self.display = X.XOpenDisplay(None)
        self.root = X.XDefaultRootWindow(self.display)
        self.window = X.XCreateSimpleWindow(self.display, self.root, 0, 0, 1, 1, 0, 0, 0)

    def atom(self, name):
        return X.XInternAtom(self.display, name.encode(), 0)

    def below_cursor(self):
        """The window that a file manager would find there, and the cursor's place."""
        window, child = self.root, Window()
        x, y, ignored, ignored_root = ctypes.c_int(), ctypes.c_int(), ctypes.c_int(), Window()
        mask = ctypes.c_uint()
        X.XQueryPointer(self.display, window, *[ctypes.byref(part) for part in
                                                (ignored_root, child, x, y, ignored, ignored, mask)])
        return child.value, x.value, y.value

    def send(self, target, name, data):
        event = Event()
        event.client.type = CLIENT_MESSAGE
        event.client.display = self.display
        event.client.window = target
        event.client.message_type = self.atom(name)
        event.client.format = 32
        for i, number in enumerate(data):
            event.client.data[i] = number
        X.XSendEvent(self.display, target, 0, 0, ctypes.byref(event))
        X.XFlush(self.display)

    def answer(self, request, text):
        X.XChangeProperty(self.display, request.requestor, request.property, request.target, 8, 0, text, len(text))
        event = Event()
        event.notify.type = SELECTION_NOTIFY
        event.notify.display = self.display
        event.notify.requestor, event.notify.selection = request.requestor, request.selection
        event.notify.target, event.notify.property, event.notify.time = request.target, request.property, request.time
        X.XSendEvent(self.display, request.requestor, 0, 0, ctypes.byref(event))
        X.XFlush(self.display)

    def drop(self, paths, seconds=10):
        """Returns whether the window took it."""
        text = "".join(pathlib.Path(os.path.abspath(path)).as_uri() + "\r\n" for path in paths).encode()
        target, x, y = self.below_cursor()
        X.XSetSelectionOwner(self.display, self.atom("XdndSelection"), self.window, 0)
        copy = self.atom("XdndActionCopy")
        self.send(target, "XdndEnter", [self.window, 5 << 24, self.atom("text/uri-list"), 0, 0])
        self.send(target, "XdndPosition", [self.window, 0, x << 16 | y, 0, copy])
        end, event = time.time() + seconds, Event()
        while time.time() < end:
            if X.XPending(self.display) == 0:
                time.sleep(0.01)
                continue
            X.XNextEvent(self.display, ctypes.byref(event))
            if event.type == SELECTION_REQUEST:
                self.answer(event.request, text)
            elif event.type == CLIENT_MESSAGE and event.client.message_type == self.atom("XdndStatus"):
                if not event.client.data[1] & 1:
                    return False
                self.send(target, "XdndDrop", [self.window, 0, 0, 0, 0])
            elif event.type == CLIENT_MESSAGE and event.client.message_type == self.atom("XdndFinished"):
                # Bit 0 by the protocol; GLFW gives the number of bytes that it took.
                return event.client.data[1] != 0
        return False


if __name__ == "__main__":
    sys.exit(0 if Source().drop(sys.argv[1:]) else "the window did not take it")
