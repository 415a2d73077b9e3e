#!/usr/bin/env python3
"""Groups the sources of targets for a unity build: prints "TARGET SOURCE=GROUP" for each, or "TARGET SOURCE=" for one that stays alone.

usage: unity.py SIZE --target TARGET SOURCE... [--target TARGET SOURCE...]...

Sources of a group are compiled as one, so no two of them may give the same name to different things in their unnamed
namespaces (the same alias twice is one thing: `namespace fs = std::filesystem;`), and none may hide a type of a header. Lines
are read as clang-format leaves them; no compiler is asked. The same sources give the same groups.
"""
import functools
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def unnamed_names(file):
    """Names that the unnamed namespaces of a source declare, by what its lines look like."""
    names, inside = set(), False
    for line in file.read_text().splitlines():
        if line == "namespace {":
            inside = True
        elif line.startswith("}  // namespace"):
            inside = False
        elif re.match(r"(?:namespace|using) (?!namespace)(\w+) =", line):
            names.add(line.split()[1])
        elif inside and re.match(r"[A-Za-z]", line):
            found = re.match(r"(?:struct|class|enum class|using)\s+(\w+)(?!\w|::)", line)
            if line.startswith("using ") and not found:  # using that::name; is among the used names
                continue
            if found:
                names.add(found.group(1))
                continue
            names |= declared_names(line)
    return names


def declared_names(line):
    """Of a function, or of the constants of one declaration: `constexpr int kA = 1, kB = 2;`"""
    line = re.sub(r"\w+::", "", line)
    function = re.match(r"[^=;{\[]*?\b([A-Za-z_]\w*)\s*\(", line)
    if function:
        return {function.group(1)} - {"TEST", "TEST_F", "TEST_P", "TYPED_TEST", "TYPED_TEST_SUITE", "INSTANTIATE_TEST_SUITE_P"}
    return set(re.findall(r"\b([A-Za-z_]\w*)\s*(?=[={\[;])", re.sub(r"=[^,;]*", "=", line)))


def aliases(file):
    """The names that a source gives to what the standard library and others have named, each with its meaning."""
    return dict(re.findall(r"^(?:namespace|using) (\w+) = ((?:std|nlohmann|Eigen)::[\w:, <>]+);", file.read_text(), re.MULTILINE))


@functools.cache
def header_names():
    """Of each header, the names of the types that it defines; and of all, those of the functions that they declare. Two headers
    that define one type would give a program two types of that name, and the linker would take the code of either for both."""
    headers, types, functions = {}, {}, set()
    for header in sorted([*(ROOT / "src").rglob("*.h"), *(ROOT / "include").rglob("*.h")]):
        text = header.read_text()
        functions |= set(re.findall(r"^(?:\[\[nodiscard\]\] )?[A-Za-z][^=;(){]*?\b(\w+)\(", text, re.MULTILINE))
        found = re.findall(r"^(?:struct|class|enum class|using) (\w+(?:::\w+)*)(?=[ :{=][^;]*(?:\{|= ))", text, re.MULTILINE)
        types[header] = set(found)
        for name in found:
            if headers.setdefault(name, (header, text))[0] != header and not re.search(rf"^using {name} =", text, re.MULTILINE):
                sys.exit(f"{name} is defined in {headers[name][0].name} and in {header.name}")
    return types, functions


@functools.cache
def included(file):
    """Our own headers that a file includes, itself or by others."""
    found = set()
    for name in re.findall(r'^#include "(.+)"', file.read_text(), re.MULTILINE):
        for folder in (ROOT / "src", ROOT / "include", ROOT / "tests", file.parent, ROOT / "apps/flank"):
            header = folder / name
            if header.is_file():
                found |= {header} | included(header)
                break
    return frozenset(found)


def opened_namespaces(file):
    """Namespaces that a source opens with `using namespace`: to the sources after it, too, so only those that open the
    same ones go with it."""
    return tuple(sorted(set(re.findall(r"^ *using namespace ([\w:]+);", file.read_text(), re.MULTILINE))))


def used_names(file):
    """Names that a source takes from other namespaces (`using that::name;`): two sources may take the same one, but none
    may declare it."""
    return set(re.findall(r"^ *using [\w:]*::(\w+);", file.read_text(), re.MULTILINE))


def local_names(file):
    """Constants and types inside functions and classes, which may not hide one of another source."""
    text = file.read_text()
    constants = re.findall(r"^ +(?:static )?(?:constexpr|const) [^({;]*", text, re.MULTILINE)
    return {name for line in constants for name in re.findall(r"\b(k[A-Z]\w*)", line)} | set(
        re.findall(r"^ +(?:struct|class|enum class|using) (\w+)(?= [={])", text, re.MULTILINE))


def groups_of(files, size):
    """Groups of at most `size`, no two sources of which share a name of an unnamed namespace; the sources with most names
    first. A source that gives another meaning to a header's type stays away from those that include that header, one that
    does so with a header's function from those that speak of it."""
    (types, functions), groups = header_names(), []
    for names, file in sorted(((unnamed_names(file), file) for file in files), key=lambda pair: (-len(pair[0]), pair[1])):
        seen, opened = set().union(*(types.get(header, ()) for header in included(file.resolve()))), opened_namespaces(file)
        used = used_names(file) | local_names(file) | set(re.findall(r"\w+", file.read_text())) & functions - names
        meant = aliases(file)
        for group in groups:
            shared = {name for name, meaning in meant.items() if group["aliases"].get(name) == meaning}
            fits = not ((names - shared) & (group["names"] | group["used"] | group["seen"])
                        or (used | seen) & (group["names"] - shared))
            if len(group["files"]) < size and group["opened"] == opened and fits:
                break
        else:
            group = {"files": [], "names": set(), "used": set(), "seen": set(), "aliases": {}, "opened": opened}
            groups.append(group)
        group["files"].append(file)
        group["aliases"].update(meant)
        for key, value in (("names", names), ("used", used), ("seen", seen)):
            group[key] |= value
    return [sorted(group["files"]) for group in groups]


def main():
    size, targets, words = int(sys.argv[1]), {}, iter(sys.argv[2:])
    for word in words:
        if word == "--target":
            files = targets.setdefault(next(words), [])
        else:
            files.append(pathlib.Path(word))
    for target, files in targets.items():
        for number, group in enumerate(groups_of(files, size)):
            for file in group:
                print(f"{target} {file}={number if len(group) > 1 else ''}")


if __name__ == "__main__":
    main()
