"""A program that does what a module must not do: hostile.py HOW [FILE]. FILE marks that it has been started before."""
import os
import signal
import socket
import struct
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench

STORM = 500  # processes: a storm that a machine survives
HOW = sys.argv[1]


def protocol():
    return socket.socket(fileno=os.dup(int(os.environ["SCANBENCH_FD"])))


def segfault(scan):
    import ctypes
    ctypes.string_at(0)


def abort(scan):
    os.abort()


def exit(scan):
    os._exit(0)


def loop(scan):
    while True:
        pass


def ignore_sigterm(scan):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    loop(scan)


def late(scan):
    time.sleep(100)


def stop(scan):
    os.kill(os.getpid(), signal.SIGSTOP)


def memory(scan):
    everything = []
    while True:
        everything.append(bytearray(64 << 20))


def memory_of_many(scan):
    """Twenty processes, each of which has less than a cell may have."""
    children = []
    for i in range(20):
        child = os.fork()
        if child == 0:
            block = b"x" * (100 << 20)
            time.sleep(2)
            os._exit(0)
        children.append(child)
    if any(os.waitpid(child, 0)[1] != 0 for child in children):
        raise RuntimeError("a process was killed")
    raise RuntimeError("two gigabytes")


def fork_storm(scan):
    for i in range(STORM):
        try:
            if os.fork() == 0:
                time.sleep(100)
                os._exit(0)
        except OSError:
            raise RuntimeError(f"no process after {i}")
    raise RuntimeError("nothing stopped the storm")


def output(scan):
    """Two gigabytes, or what this machine takes in a second."""
    end = time.monotonic() + 1
    for i in range(2048):
        if time.monotonic() > end:
            break
        os.write(1, b"x" * (1 << 20))
    raise RuntimeError("written")


def flood(scan):
    """Gigabytes into the protocol instead of an answer."""
    connection = protocol()
    for i in range(2048):
        connection.sendall(b"x" * (1 << 20))


def huge_answer(scan):
    protocol().sendall(struct.pack("<4sIQ", b"SBF1", 2, 1 << 40) + b"{}")
    time.sleep(100)


def more_answers(scan):
    """An answer that nobody requested, before the one that was."""
    text = b'{"id": 1}'
    protocol().sendall(struct.pack("<4sIQ", b"SBF1", len(text), 0) + text)
    return []


def close_descriptors(scan):
    os.closerange(0, 100)
    return []


def kill_worker(scan):
    os.kill(os.getppid(), signal.SIGKILL)
    time.sleep(100)


def kill_scanbench(scan):
    worker = os.getppid()
    with open(f"/proc/{worker}/stat") as file:
        main = int(file.read().rsplit(")", 1)[1].split()[1])
    os.kill(main, signal.SIGTERM)
    os.kill(main, signal.SIGINT)
    time.sleep(100)


def daemon(scan):
    """Leaves a process in a session of its own."""
    told, tell = os.pipe()
    if os.fork() == 0:
        os.setsid()
        if os.fork() == 0:
            os.write(2, f"daemon {os.getpid()}\n".encode())
            os.closerange(0, 3)
            os.write(tell, b"x")
            time.sleep(100)
        os._exit(0)
    os.read(told, 1)
    os.abort()


def nan(scan):
    line = scan.fitted_line(scan.valid_beams())
    line.rho = float("nan")
    return [line]


def too_many_labels(scan):
    return {}, {"lines": [], "labels": [-1.0] * (len(scan.ranges) + 1)}


def wrong_kind(scan):
    return {"status": "converged"}, {"pose": [0.0, 0.0, 1.0, 0.0]}


class Hostile:
    kind, name, version = "extract", "hostile", "1"

    def __init__(self, params):
        pass

    def extract(self, scan):
        return globals()[HOW](scan)


if HOW in ("too_many_labels", "wrong_kind"):  # answers that the client would not make
    scanbench._CALLS["extract"] = lambda module, arrays, sensor: module.extract(scanbench.Scan(sensor, arrays["ranges"], 0.0))
if len(sys.argv) > 2:  # it is good at first, when scanbench asks for its description
    if not os.path.exists(sys.argv[2]):
        open(sys.argv[2], "w").close()
    elif HOW == "exit_at_once":
        sys.exit(5)
    elif HOW == "other_protocol":
        scanbench.PROTOCOL = 2
    elif HOW == "other_name":
        Hostile.name = "friendly"
scanbench.serve(Hostile)
