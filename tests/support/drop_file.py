#!/usr/bin/python3
"""Drops a file on a window, as a file manager would. This is the source's part of the XDND protocol, version 5.

usage: drop_file.py WINDOW FILE
"""
import pathlib
import sys

from Xlib import X, display
from Xlib.protocol import event


class Source:
    def __init__(self, target):
        self.display = display.Display()
        self.window = self.display.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
        self.target = self.display.create_resource_object("window", target)

    def atom(self, name):
        return self.display.intern_atom(name)

    def tell(self, name, numbers):
        data = (32, [self.window.id] + numbers)
        self.target.send_event(event.ClientMessage(window=self.target, client_type=self.atom(name), data=data))

    def await_message(self, name, uri):
        """Waits for the target's message, and gives it the file's name when it asks."""
        while True:
            received = self.display.next_event()
            if received.type == X.SelectionRequest:
                received.requestor.change_property(received.property, received.target, 8, uri.encode())
                received.requestor.send_event(
                    event.SelectionNotify(time=received.time, requestor=received.requestor, selection=received.selection,
                                          target=received.target, property=received.property))
            elif received.type == X.ClientMessage and received.client_type == self.atom(name):
                return received.data[1]

    def drop(self, uri):
        self.window.set_selection_owner(self.atom("XdndSelection"), X.CurrentTime)
        place = self.target.translate_coords(self.display.screen().root, 0, 0)
        root_x, root_y = 10 - place.x, 10 - place.y
        self.tell("XdndEnter", [5 << 24, self.atom("text/uri-list"), 0, 0])
        self.tell("XdndPosition", [0, root_x << 16 | root_y, X.CurrentTime, self.atom("XdndActionCopy")])
        if not self.await_message("XdndStatus", uri)[1] & 1:
            sys.exit("the window takes no files")
        self.tell("XdndDrop", [0, X.CurrentTime, 0, 0])
        self.await_message("XdndFinished", uri)


Source(int(sys.argv[1])).drop(pathlib.Path(sys.argv[2]).resolve().as_uri() + "\r\n")
