"""A program that tries one way out of the sandbox: escapes.py WAY. Its answer is an error that says "refused" or "ESCAPED".

What it tries to reach is in the environment, because the sandbox shows a program the files among its arguments:
ESCAPE_RUN, ESCAPE_FILE, ESCAPE_SOCKET, ESCAPE_SHOWN_SOCKET, ESCAPE_PORT and ESCAPE_PROCESS, which is a process of the same user.
"""
import ctypes
import os
import signal
import socket
import stat
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../clients"))
import scanbench

LIBC = ctypes.CDLL(None, use_errno=True)
STORM = 200  # processes: a storm that a machine survives
RUN = os.environ["ESCAPE_RUN"]
PROCESS = int(os.environ["ESCAPE_PROCESS"])


class Escaped(Exception):
    pass


def attempt(way, *arguments):
    """A way that works is an escape; the reason why it does not is returned."""
    try:
        way(*arguments)
    except OSError as error:
        return os.strerror(error.errno) if error.errno else str(error)
    raise Escaped(f"{way.__name__}{arguments}")


def system_call(name, *arguments):
    def call(*_):
        if getattr(LIBC, name)(*arguments) != 0:
            raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    call.__name__ = name
    return attempt(call)


def open_for_writing(file):
    os.close(os.open(file, os.O_WRONLY))


def remount():
    bind_remount, new_user_and_mounts, detach = 4096 | 32, 0x10000000 | 0x00020000, 2
    reasons = [system_call("mount", None, b"/", None, bind_remount, None), system_call("umount2", b"/tmp", detach),
               system_call("unshare", new_user_and_mounts)]
    return ", ".join(reasons)


def terminal():
    for descriptor in range(3):
        if os.isatty(descriptor):
            raise Escaped(f"descriptor {descriptor} is a terminal")
    return attempt(os.open, "/dev/tty", os.O_RDWR)  # what TIOCSTI would be called with


def fifo():
    return ", ".join(attempt(os.mkfifo, f"{folder}/status.json") for folder in ("..", RUN))


def links():
    reasons = [attempt(os.symlink, "/etc/passwd", f"{folder}/map.csv") for folder in ("..", RUN)]
    return ", ".join(reasons + [attempt(os.link, os.path.abspath(__file__), "mine")])


def sockets():
    paths = [os.environ["ESCAPE_SOCKET"], os.environ["ESCAPE_SHOWN_SOCKET"]]
    addresses = paths + ["\0" + os.path.basename(paths[0])]
    return ", ".join(attempt(socket.socket(socket.AF_UNIX).connect, address) for address in addresses)


def network():
    return attempt(socket.socket().connect, ("127.0.0.1", int(os.environ["ESCAPE_PORT"])))


def processes():
    for pid in filter(str.isdigit, os.listdir("/proc")):
        with open(f"/proc/{pid}/comm") as file:
            if file.read().strip() == "scanbench":
                raise Escaped(f"sees scanbench as {pid}")
    return "sees no scanbench"


def truth():
    for folder, _, names in os.walk(os.path.dirname(RUN)):
        if "walls.csv" in names:
            raise Escaped(f"reads the walls in {folder}")
    return "finds no walls"


def results():
    return attempt(open_for_writing, f"{RUN}/manifest.json")


def files():
    return attempt(open, os.environ["ESCAPE_FILE"], "w")


def signals():
    reason = attempt(os.kill, PROCESS, signal.SIGCONT)
    with open("/proc/1/comm") as file:
        if file.read().strip() == "bwrap":  # and not the first process of the machine
            os.kill(1, signal.SIGKILL)  # does nothing from inside
    return reason


def core_pattern():
    return ", ".join(attempt(open_for_writing, file) for file in ("/proc/sys/kernel/core_pattern", "/proc/sysrq-trigger"))


def descriptors():
    """Its standard descriptors and the socket of the protocol, and no file or folder among them."""
    found = {}
    for descriptor in map(int, os.listdir("/proc/self/fd")):
        try:
            found[descriptor] = os.fstat(descriptor).st_mode
        except OSError:
            pass  # that of listdir()
    expected = {0: stat.S_ISCHR, 1: stat.S_ISFIFO, 2: stat.S_ISFIFO, 3: stat.S_ISSOCK}
    for descriptor, mode in found.items():
        if not expected.get(descriptor, lambda _: False)(mode):
            raise Escaped(f"has descriptor {descriptor} of mode {mode:o}")
    return f"has {sorted(found)}"


def trace():
    seize = 0x4206
    return system_call("ptrace", seize, PROCESS, None, None)


def storm():
    children = []
    try:
        for i in range(STORM):
            child = os.fork()
            if child == 0:
                time.sleep(100)
                os._exit(0)
            children.append(child)
    except OSError:
        return f"no process after {len(children)}"
    finally:
        for child in children:
            os.kill(child, signal.SIGKILL)
    raise Escaped(f"{STORM} processes")


class Escapes:
    kind, name, version = "extract", "escapes", "1"

    def __init__(self, params):
        pass

    def extract(self, scan):
        try:
            outcome = "refused: " + globals()[sys.argv[1]]()
        except Escaped as escaped:
            outcome = f"ESCAPED: {escaped}"
        raise RuntimeError(outcome)


scanbench.serve(Escapes)
