# SPDX-License-Identifier: MIT
"""A serial line with faults: a pseudo-terminal on one side, a socket on the other, and a thread that carries frames between them."""
import os
import random
import select
import threading
import time
import tty

GAP_S = 0.002  # a frame ends with a silence; on a pseudo-terminal it comes in one piece or two
KINDS = ("drop", "truncate", "flip", "insert", "repeat", "delay")


class FaultyLine:
    """`share`: of the frames that something happens to, in both directions."""

    def __init__(self, uart, share=0.0, seed=0):
        self.uart, self.share, self.random = uart, share, random.Random(seed)
        self.master, self.slave = os.openpty()
        tty.setraw(self.slave)
        self.path = os.ttyname(self.slave)
        self.counts = dict.fromkeys(KINDS, 0)
        self.frames = 0
        self.ends = False
        self.thread = threading.Thread(target=self.carry, daemon=True)
        self.thread.start()

    def close(self):
        self.ends = True
        self.thread.join()
        os.close(self.master)
        os.close(self.slave)

    def carry(self):
        ways = {self.master: self.uart.fileno(), self.uart.fileno(): self.master}
        while not self.ends:
            for source in select.select(list(ways), [], [], 0.05)[0]:
                frame = b""
                while select.select([source], [], [], GAP_S)[0]:
                    if not (more := os.read(source, 4096)):
                        return
                    frame += more
                for piece in self.spoiled(frame):
                    while piece:
                        piece = piece[os.write(ways[source], piece):]

    def spoiled(self, frame):
        """What becomes of a frame: the pieces that arrive."""
        self.frames += 1
        if self.random.random() >= self.share:
            return [frame]
        kind = self.random.choice(KINDS)
        self.counts[kind] += 1
        at = self.random.randrange(len(frame))
        noise = bytes([self.random.randrange(256)])
        if kind == "delay":
            time.sleep(self.random.uniform(0.005, 0.15))
        return {"drop": [], "truncate": [frame[:at]], "repeat": [frame, frame], "delay": [frame],
                "flip": [frame[:at] + bytes([frame[at] ^ 1 << self.random.randrange(8)]) + frame[at + 1:]],
                "insert": [frame[:at] + noise + frame[at:]]}[kind]
