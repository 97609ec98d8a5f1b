#!/usr/bin/python3
"""What the protocol web-load measures Docent's server against: the same stream of poses from python3-tornado, spread over ten parts
as Docent's are. Prints its port; runs until its standard input ends."""
import json
import math
import sys
import time

import tornado.httpserver
import tornado.ioloop
import tornado.netutil
import tornado.web
import tornado.websocket

PARTS, PERIOD = 10, 0.3  # [s]
viewers = [set() for _ in range(PARTS)]
count = 0


class Live(tornado.websocket.WebSocketHandler):
    def check_origin(self, origin):
        return True

    def open(self, *_):
        global count
        self.set_nodelay(True)
        self.part = viewers[count % PARTS]
        count += 1
        self.part.add(self)

    def on_close(self):
        self.part.discard(self)


def pose():
    now = time.monotonic()
    angle = 0.1 * now
    return json.dumps({"type": "pose", "t": round(now, 4), "pose": [round(10 + 4 * math.cos(angle), 4), round(8 + 4 * math.sin(angle), 4),
                       round(angle % math.tau, 4)], "v": 0.4, "w": 0.1, "p_lost": 0.01, "battery": 0.87})


def main():
    loop = tornado.ioloop.IOLoop.current()
    sockets = tornado.netutil.bind_sockets(0, "127.0.0.1", backlog=4096)
    tornado.httpserver.HTTPServer(tornado.web.Application([(r"/live", Live)])).add_sockets(sockets)
    part = 0

    def tell():
        nonlocal part
        text = pose()
        for viewer in list(viewers[part]):
            try:
                viewer.write_message(text)
            except tornado.websocket.WebSocketClosedError:
                viewers[part].discard(viewer)
        part = (part + 1) % PARTS

    tornado.ioloop.PeriodicCallback(tell, 1e3 * PERIOD / PARTS).start()
    loop.add_handler(sys.stdin.fileno(), lambda *_: loop.stop(), loop.READ)
    print(sockets[0].getsockname()[1], flush=True)
    loop.start()


if __name__ == "__main__":
    main()
