"""A good module whose connection damages an answer at random: mutates.py SEED."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench

RANDOM = random.Random(int(sys.argv[1]))


def mutated(frame):
    frame = bytearray(frame)
    for _ in range(RANDOM.randint(1, 3)):
        where = RANDOM.random()  # in the head, in the JSON that follows it, in the numbers
        at = RANDOM.randrange(16 if where < 0.1 else 200 if where < 0.5 else len(frame) + 1)
        kind = RANDOM.randrange(4)
        if kind == 0 and at < len(frame):
            frame[at] ^= 1 << RANDOM.randrange(8)
        elif kind == 1:
            del frame[at:at + RANDOM.randint(1, 8)]
        elif kind == 2:
            frame[at:at] = bytes(RANDOM.randrange(256) for _ in range(RANDOM.randint(1, 8)))
        else:
            frame[at:at + 8] = RANDOM.choice([b"\xff" * 8, b"\0" * 8, b"\0\0\0\0\0\0\xf0\x7f", b"[[[[[[[["])
    return bytes(frame)


class Connection(scanbench.socket.socket):
    answers = 0

    def sendall(self, frame):
        Connection.answers += 1
        super().sendall(frame if Connection.answers < 3 else mutated(frame))  # hello and make are good


class Mutates:
    kind, name, version = "extract", "mutates", "1"

    def __init__(self, params):
        pass

    def extract(self, scan):
        return [scan.fitted_line(scan.valid_beams())]


scanbench.socket.socket = Connection
scanbench.serve(Mutates)
