"""A cable between a gateway and its database, as a program: a port that leads to another one. Words on its standard input: `cut` closes all that is
open and whatever comes, `hang` leaves it open and carries nothing, `mend` makes it whole. It ends with its input."""
import os
import selectors
import socket
import sys


def run(at, to):
    selector = selectors.DefaultSelector()
    server = socket.create_server(("127.0.0.1", at), backlog=64)
    selector.register(server, selectors.EVENT_READ, "server")
    selector.register(sys.stdin.fileno(), selectors.EVENT_READ, "word")
    peers, state = {}, "mend"

    def drop(one):
        other = peers.pop(one, None)
        for end in (one, other):
            if end is None:
                continue
            peers.pop(end, None)
            try:
                selector.unregister(end)
            except (KeyError, ValueError):
                pass
            end.close()

    def watch(all_of_them):
        for end in list(peers):
            try:
                selector.unregister(end)
            except (KeyError, ValueError):
                pass
            if all_of_them:
                selector.register(end, selectors.EVENT_READ, "end")

    while True:
        for key, _ in selector.select(1.0):
            if key.data == "word":
                word = os.read(sys.stdin.fileno(), 64).decode().split()
                if not word:
                    return
                state = word[-1]
                if state == "cut":
                    for end in list(peers):
                        drop(end)
                watch(state == "mend")
            elif key.data == "server":
                near = server.accept()[0]
                if state == "cut":
                    near.close()
                    continue
                try:
                    far = socket.create_connection(("127.0.0.1", to))
                except OSError:  # the database has ended
                    near.close()
                    continue
                for end in (near, far):
                    end.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                peers[near], peers[far] = far, near
                if state == "mend":
                    selector.register(near, selectors.EVENT_READ, "end")
                    selector.register(far, selectors.EVENT_READ, "end")
            elif key.fileobj in peers:
                try:
                    data = key.fileobj.recv(1 << 16)
                    if data:
                        peers[key.fileobj].sendall(data)
                except OSError:
                    data = b""
                if not data:
                    drop(key.fileobj)


if __name__ == "__main__":
    run(int(sys.argv[1]), int(sys.argv[2]))
