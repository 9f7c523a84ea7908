"""Power cuts, reconstructed from the record of all calls that change files: what had not been synced may be lost, torn or zero.

The model of the disk: names (create, rename, unlink) come to it in their order, and are sure after a sync of their folder; the bytes of a file come in
the order in which they were written, and are sure after a sync of the file; beyond that, any prefix of either may have arrived, the last write in part
or as zeros.
"""

import shutil
import struct
from dataclasses import dataclass
from pathlib import Path

from campaign import Defect, jostle, require_ending
from faults import ARGUMENTS, KINDS, interposer, prepared
from jostle_command import DONE, require_same_results

NAMES = ("create", "rename", "unlink", "mkdir")


@dataclass
class Call:
    operation: str
    path: str
    other: str
    offset: int
    content: bytes
    file: int = -1  # the file that it concerns, whatever its name: numbered by the calls that created them


def read_log(path):
    """The calls of a record that fault.c wrote."""
    content = path.read_bytes()
    calls, at = [], 0
    while at < len(content):
        texts = []
        for _ in range(3):
            end = content.index(b"\0", at)
            texts.append(content[at:end].decode())
            at = end + 1
        offset, length = struct.unpack_from("<qq", content, at)
        calls.append(Call(*texts, offset, content[at + 16:at + 16 + length]))
        at += 16 + length
    return calls


def number_files(calls):
    """Says for each call which file it concerns."""
    files, count = {}, 0
    for call in calls:
        if call.operation == "create":
            files[call.path] = count
            count += 1
        call.file = files.get(call.path, -1)
        if call.operation == "rename":
            files[call.other] = files.pop(call.path, -1)
        elif call.operation == "unlink":
            files.pop(call.path, None)


def last_sync(calls, end, found):
    """The number of calls up to the last sync that `found` admits, or 0."""
    return max((k + 1 for k in range(end) if calls[k].operation == "sync" and found(calls[k])), default=0)


def after_power_cut(calls, end, random):
    """Names and contents on the disk if the power fails after `end` calls: {path: bytes, or None for a folder}."""
    folders = {str(Path(call.path).parent) for call in calls}
    arrived = {folder: random.randint(last_sync(calls, end, lambda call: call.path == folder), end) for folder in folders}
    names = {}
    for k, call in enumerate(calls[:end]):
        if call.operation not in NAMES or k >= arrived[str(Path(call.path).parent)]:
            continue
        if call.operation == "create":
            names[call.path] = call.file
        elif call.operation == "mkdir":
            names[call.path] = None
        elif call.operation == "unlink":
            names.pop(call.path, None)
        elif call.path in names:
            names[call.other] = names.pop(call.path)
    return {path: None if file is None else content_of(calls, end, file, random) for path, file in names.items()}


def content_of(calls, end, file, random):
    written = [k for k in range(end) if calls[k].file == file and calls[k].operation in ("write", "truncate")]
    sure = last_sync(calls, end, lambda call: call.file == file)
    arrived = random.randint(sum(k < sure for k in written), len(written))
    content = bytearray()
    for number, k in enumerate(written[:arrived]):
        call = calls[k]
        if call.operation == "truncate":
            del content[call.offset:]
            content.extend(bytes(call.offset - len(content)))
            continue
        piece = call.content
        if number == arrived - 1 and k >= sure:
            piece = random.choice([piece, piece[:random.randrange(len(piece) + 1)], bytes(len(piece))])
        content.extend(bytes(max(0, call.offset - len(content))))
        content[call.offset:call.offset + len(piece)] = piece
    return bytes(content)


def cases(random, folder):
    """One power cut a case."""
    library = interposer(folder / "faults")
    recorded = {}
    for name, scene in KINDS.items():
        place = prepared(folder / "power" / name, scene)
        log = place / "log"
        require_ending(jostle(place, *ARGUMENTS, environment={"LD_PRELOAD": str(library), "JOSTLE_FAULT_LOG": str(log)}), DONE)
        calls = read_log(log)
        number_files(calls)
        recorded[name] = (place, calls)
    while True:
        name = random.choice(list(KINDS))
        origin, calls = recorded[name]
        end = random.randint(0, len(calls))
        disk = after_power_cut(calls, end, random)
        yield lambda: try_disk(folder, name, origin, disk, end)


def try_disk(folder, name, origin, disk, end):
    place = prepared(folder / "power/work", KINDS[name])
    run = str(origin / "run")
    for path in sorted(disk):
        if path != run and not path.startswith(run + "/"):
            continue
        target = place / Path(path).relative_to(origin)
        if disk[path] is None:
            target.mkdir(exist_ok=True)
        elif target.parent.is_dir():
            target.write_bytes(disk[path])
    state = sorted((entry.name, entry.stat().st_size) for entry in (place / "run").iterdir()) if (place / "run").exists() else []
    try:
        require_ending(jostle(place, *ARGUMENTS), DONE)
        require_same_results(place / "run", origin / "run")
    except (AssertionError, Defect) as difference:
        raise Defect(f"{name}, power cut after call {end}, {state}: {difference}") from None
    finally:
        shutil.rmtree(place / "run", ignore_errors=True)
