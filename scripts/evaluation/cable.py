"""A cable between a gateway and its database, as a program: a port that leads to another one. Words on its standard input: `cut` closes all that is
open and whatever comes, `hang` leaves it open and carries nothing, `mend` makes it whole. It ends with its input."""
import os
import selectors
import socket
import sys


class Cable:
    def __init__(self, at, to):
        self.to, self.peers, self.state = to, {}, "mend"
        self.selector = selectors.DefaultSelector()
        self.server = socket.create_server(("127.0.0.1", at), backlog=64)
        self.selector.register(self.server, selectors.EVENT_READ)
        self.selector.register(sys.stdin.fileno(), selectors.EVENT_READ)

    def unwatch(self, end):
        try:
            self.selector.unregister(end)
        except (KeyError, ValueError):
            pass

    def drop(self, one):
        for end in (one, self.peers.get(one)):
            if self.peers.pop(end, None) is not None:
                self.unwatch(end)
                end.close()

    def obey(self, word):
        self.state = word
        for end in list(self.peers):
            self.unwatch(end)
            if word == "mend":
                self.selector.register(end, selectors.EVENT_READ)
            elif word == "cut":
                self.drop(end)

    def accept(self):
        near = self.server.accept()[0]
        try:
            far = None if self.state == "cut" else socket.create_connection(("127.0.0.1", self.to))
        except OSError:  # the database has ended
            far = None
        if far is None:
            return near.close()
        self.peers[near], self.peers[far] = far, near
        for end in (near, far):
            end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            if self.state == "mend":
                self.selector.register(end, selectors.EVENT_READ)
        return None

    def carry(self, end):
        try:
            data = end.recv(1 << 16)
            if data:
                self.peers[end].sendall(data)
        except OSError:
            data = b""
        if not data:
            self.drop(end)

    def run(self):
        while True:
            for key, _ in self.selector.select(1.0):
                if key.fileobj == self.server:
                    self.accept()
                elif key.fileobj in self.peers:
                    self.carry(key.fileobj)
                elif key.fileobj == sys.stdin.fileno():
                    words = os.read(sys.stdin.fileno(), 64).decode().split()
                    if not words:
                        return
                    for word in words:
                        self.obey(word)


if __name__ == "__main__":
    Cable(int(sys.argv[1]), int(sys.argv[2])).run()
