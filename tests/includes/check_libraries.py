"""check_libraries.py ROOT: each library of CMake has its sources in one folder, and each folder one library.

Folders of variants (kernels, parametrization, sampling, material) belong to the library of the folder around them. Two
libraries are compiled twice, with either HDF5: h5 and snapshot, whose second name ends in _mpi. Sources that are commands'
main functions belong to no library. Prints what breaks the rule and exits with 1.
"""

import glob
import os
import re
import sys

PARTS = ("base", "params", "solver", "encoder", "haptic", "explorer", "tradeoff")
VARIANTS = ("kernels", "parametrization", "sampling", "material")
LIBRARY = re.compile(r"(?:cleft_library|add_library)\(\s*(\w+)([^)]*)\)")
SOURCE = re.compile(r"[\w./${}]+\.cpp")


def home(folder):
    """The folder of the library that a source in `folder` belongs to."""
    return os.path.dirname(folder) if os.path.basename(folder) in VARIANTS else folder


def text_of(path):
    with open(path) as file:
        return re.sub(r"#.*", "", file.read())


def violations(root):
    libraries = {}  # folder: names
    listed = set()
    for part in PARTS:
        for folder, _, files in os.walk(os.path.join(root, part)):
            if "CMakeLists.txt" not in files:
                continue
            text = text_of(os.path.join(folder, "CMakeLists.txt"))
            # A variable stands for all lists of sources that it may hold.
            lists = {}
            for name, values in re.findall(r"set\(\s*(\w+)\s+([^)]*)\)", text):
                lists[name] = lists.get(name, "") + " " + values
            for name, pattern in re.findall(r"file\(\s*GLOB\s+(\w+)\s+(?:CONFIGURE_DEPENDS\s+)?(\S+?)\s*\)", text):
                found = glob.glob(os.path.join(folder, pattern))
                lists[name] = lists.get(name, "") + " " + " ".join(os.path.relpath(path, folder) for path in found)
            for name, values in lists.items():
                text = text.replace("${%s}" % name, values)
            for name, arguments in LIBRARY.findall(text):
                sources = [os.path.normpath(os.path.join(folder, s)) for s in SOURCE.findall(arguments)]
                homes = sorted({os.path.relpath(home(os.path.dirname(s)), root) for s in sources})
                listed.update(sources)
                if len(homes) > 1:
                    yield "library %s has sources in several folders: %s" % (name, " ".join(homes))
                for place in homes:
                    libraries.setdefault(place, set()).add(re.sub(r"_mpi$", "", name))
    for place, names in sorted(libraries.items()):
        if len(names) > 1:
            yield "folder %s has several libraries: %s" % (place, " ".join(sorted(names)))
    for part in PARTS:
        for folder, _, files in os.walk(os.path.join(root, part)):
            for file in sorted(files):
                path = os.path.join(folder, file)
                if file.endswith(".cpp") and not file.endswith("_main.cpp") and os.path.normpath(path) not in listed:
                    yield "%s belongs to no library" % os.path.relpath(path, root)


if __name__ == "__main__":
    found = list(violations(sys.argv[1]))
    print("\n".join(found) if found else "each library is one folder, and each folder one library")
    sys.exit(1 if found else 0)
