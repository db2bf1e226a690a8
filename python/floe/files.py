"""Files without being led astray: what is read is an ordinary file, what is written takes the place of ordinary files only.

The same rules as floe's own (docs/outputs.md, What protects the files): a file is made anew beside its place, in a folder
that is opened once, and renamed; no link is followed, and no pipe or device is waited for or replaced.
"""
import os
import pathlib
import stat


class Refused(Exception):
    """What is not done, and why; `status` is the exit status of the command: 2 bad input, 4 input or output failed."""

    def __init__(self, text: str, status: int = 4):
        super().__init__(text)
        self.status = status


def special_kind(mode: int) -> str | None:
    """What a mode is of; None: an ordinary file."""
    for test, name in ((stat.S_ISREG, None), (stat.S_ISDIR, "a folder"), (stat.S_ISFIFO, "a named pipe"), (stat.S_ISLNK, "a symbolic link"),
                       (stat.S_ISSOCK, "a socket")):
        if test(mode):
            return name
    return "a device"


def reason(error: OSError) -> str:
    return (error.strerror or str(error)).lower() if error.errno else str(error)


def read(path: os.PathLike | str) -> bytes:
    """An ordinary file as bytes; links to one are followed, pipes are not waited for."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        with open(descriptor, "rb") as file:
            special = special_kind(os.fstat(descriptor).st_mode)
            if special:
                raise Refused(f"cannot read '{path}': it is not an ordinary file, but {special}")
            return file.read()
    except OSError as error:
        raise Refused(f"cannot read '{path}': {reason(error)}") from error


def read_text(path: os.PathLike | str) -> str:
    return read(path).decode("utf-8", errors="replace")


def _refuse_special(folder: int, name: str, path: pathlib.Path) -> None:
    try:
        special = special_kind(os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode)
    except FileNotFoundError:
        return
    if special:
        raise Refused(f"cannot write '{path}': there is {special}, not an ordinary file")


def _create(folder: int, name: str) -> int:
    """A new file. What a kill has left under its name, or someone has put there, goes."""
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC
    try:
        return os.open(name, flags, 0o666, dir_fd=folder)
    except FileExistsError:
        os.unlink(name, dir_fd=folder)
        return os.open(name, flags, 0o666, dir_fd=folder)


def _write_new(folder: int, name: str, temporary: str, data: bytes) -> None:
    try:
        with open(_create(folder, temporary), "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.rename(temporary, name, src_dir_fd=folder, dst_dir_fd=folder)
    except OSError:
        try:
            os.unlink(temporary, dir_fd=folder)
        except OSError:
            pass
        raise


def replace(path: os.PathLike | str, data: bytes | str) -> None:
    """Writes a file, whole or not at all, in the place of an ordinary file or of none."""
    path = pathlib.Path(path)
    data = data.encode() if isinstance(data, str) else data
    try:
        folder = os.open(path.parent, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
        try:
            _refuse_special(folder, path.name, path)
            _write_new(folder, path.name, path.name + ".tmp", data)
        finally:
            os.close(folder)
    except OSError as error:
        raise Refused(f"cannot write '{path}': {reason(error)}") from error


def make_folder(path: os.PathLike | str) -> None:
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        raise Refused(f"cannot make the folder '{path}': {reason(error)}") from error


def stem(text: str) -> str:
    """The stem of a file from any text: what is not a letter, a digit, '.', '_' or '-' becomes '_'."""
    out = "".join(c if c.isascii() and (c.isalnum() or c in "._-") else "_" for c in text)[:127]
    if out[:1] in (".", "-"):
        out = "_" + out[1:]
    return out or "plot"
