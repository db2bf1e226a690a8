"""E9: every key of the deck's reference, changed in a scene where it matters, in each coupling: heeded, refused or warned of.

The list is made by tests/cli/keys.sh, which fails on a key that changes nothing without a word.
"""
import collections
import os
import subprocess

import rows

COUPLINGS = ("mpm", "ice", "ice-mpm")


def measure(page):
    rows.OUT.mkdir(parents=True, exist_ok=True)
    path = rows.OUT / "e9.txt"
    environment = dict(os.environ, FLOE=str(rows.FLOE), FLOE_SOURCE=str(rows.ROOT), FLOE_VERDICTS=str(path))
    path.unlink(missing_ok=True)
    done = subprocess.run(["bash", str(rows.ROOT / "tests/cli/keys.sh")], env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    silent = [line for line in done.stdout.splitlines() if "nothing is said" in line]
    verdicts = collections.defaultdict(lambda: collections.defaultdict(set))
    for line in path.read_text().splitlines():
        key, coupling, verdict = line.split(" ")[:3]
        verdict = verdict.rstrip(":")
        if verdict != "refused-scene":
            verdicts[key][coupling].add(verdict)
    page.write("Each key of the reference is changed in a scene where it should matter, as each coupling that the scene runs as "
               "(`tests/cli/keys.sh`). A dash: the scene that has the key does not run so, and says why.")
    page.table(["key", *COUPLINGS],
               [["`" + key + "`"] + [", ".join(sorted(verdicts[key][c])) or "-" for c in COUPLINGS]
                for key in sorted(verdicts) if any("heeded" not in verdicts[key][c] for c in COUPLINGS)])
    page.write(f"{len(verdicts)} keys; those that are not in the table are heeded by all three.")
    for line in silent:
        page.write("* " + line)
    page.bar("keys that change nothing, and nothing is said", len(silent), None, 0)
    page.bar("exit status of the test", done.returncode, None, 0)
