#!/usr/bin/env python3
"""Groups the sources of a target for a unity build: prints "SOURCE=GROUP" for each, or "SOURCE=" for one that stays alone.

usage: unity.py SIZE SOURCE...

Sources of a group are compiled as one, so no two of them may give the same name to different things in their unnamed
namespaces, and none may hide a type of a header. Lines are read as clang-format leaves them; no compiler is asked. The same
sources give the same groups.
"""
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
            found = re.match(r"(?:struct|class|enum class|using)\s+(\w+)", line)
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
        return {function.group(1)} - {"TEST", "TEST_F", "TEST_P"}
    return set(re.findall(r"\b([A-Za-z_]\w*)\s*(?=[={\[;])", re.sub(r"=[^,;]*", "=", line)))


def header_names():
    """Names of the types that the headers define, and of the functions that they declare. Two headers that define one type
    would give a program two types of that name, and the linker would take the code of either for both."""
    headers, functions = {}, set()
    for header in sorted([*(ROOT / "src").rglob("*.h"), *(ROOT / "include").rglob("*.h")]):
        text = header.read_text()
        functions |= set(re.findall(r"^(?:\[\[nodiscard\]\] )?[A-Za-z][^=;(){]*?\b(\w+)\(", text, re.MULTILINE))
        for name in re.findall(r"^(?:struct|class|enum class|using) (\w+(?:::\w+)*)(?=[ :{=][^;]*(?:\{|= ))", text, re.MULTILINE):
            if headers.setdefault(name, (header, text))[0] != header and not re.search(rf"^using {name} =", text, re.MULTILINE):
                sys.exit(f"{name} is defined in {headers[name][0].name} and in {header.name}")
    return set(headers), functions


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
    return set(re.findall(r"^ +(?:static )?(?:constexpr|const) [^=({]*?\b(k[A-Z]\w*)", text, re.MULTILINE)) | set(
        re.findall(r"^ +(?:struct|class|enum class|using) (\w+)(?= [={])", text, re.MULTILINE))


def groups_of(files, size):
    """Groups of at most `size`, no two sources of which share a name of an unnamed namespace; the sources with most names
    first. A source that gives a header's type another meaning stays alone; one that does so with a header's function stays
    away from those that speak of it."""
    (types, functions), alone, groups = header_names(), [], []
    for names, file in sorted(((unnamed_names(file), file) for file in files), key=lambda pair: (-len(pair[0]), pair[1])):
        if names & types:
            alone.append([file])
            continue
        used, opened = used_names(file) | local_names(file), opened_namespaces(file)
        used |= set(re.findall(r"\w+", file.read_text())) & functions - names
        for group in groups:
            fits = not (names & group["names"] or names & group["used"] or used & group["names"])
            if len(group["files"]) < size and group["opened"] == opened and fits:
                break
        else:
            group = {"files": [], "names": set(), "used": set(), "opened": opened}
            groups.append(group)
        group["files"].append(file)
        group["names"] |= names
        group["used"] |= used
    return [sorted(group["files"]) for group in groups] + alone


def main():
    size, files = int(sys.argv[1]), [pathlib.Path(word) for word in sys.argv[2:]]
    for number, group in enumerate(groups_of(files, size)):
        for file in group:
            print(f"{file}={number if len(group) > 1 else ''}")


if __name__ == "__main__":
    main()
