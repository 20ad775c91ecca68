"""single_commands.py BUILD OUT: OUT/compile_commands.json, with which clang-tidy checks single sources.

BUILD's own database names the files of unity builds, which include several sources each: every source gets the command of
the file that includes it. clang cannot read GCC's precompiled headers, so that sources are read without them.
"""

import json
import os
import re
import sys


def sources_of(file):
    """The sources that a unity file includes; the file itself where it is none."""
    if not re.search(r"/Unity/unity_\d+_cxx\.cxx$", file):
        return [file]
    with open(file) as text:
        return re.findall(r'^#include "(.+)"', text.read(), re.MULTILINE)


if __name__ == "__main__":
    build, out = sys.argv[1:]
    with open(os.path.join(build, "compile_commands.json")) as file:
        entries = json.load(file)
    single = []
    for entry in entries:
        command = re.sub(r" -include \S*cmake_pch\.hxx| -Winvalid-pch| -fpch-preprocess", "", entry["command"])
        command = re.sub(r" --param=ggc-\S+", "", command)
        for source in sources_of(entry["file"]):
            single.append(
                {"directory": entry["directory"], "command": command.replace(entry["file"], source), "file": source})
    with open(os.path.join(out, "compile_commands.json"), "w") as file:
        json.dump(single, file, indent=0)
