#!/usr/bin/env bash
# Makes the source archive of a release: what is committed, and the pages as they were built, so that a build needs neither npm nor a
# network. The same commit gives the same bytes.
# usage: source-archive.sh BUILD FOLDER
#   BUILD   a build tree with the report page, of the same commit
#   FOLDER  where openflank-VERSION.tar.gz is written
set -euo pipefail
build=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
cd "$(dirname "$0")/.."

version=$(sed -n 's/^project(OpenFlank VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
pages=$build/web/page_template.cpp
[[ -n $version ]] || { echo "source-archive.sh: no version in CMakeLists.txt" >&2; exit 1; }
[[ -f $pages ]] || { echo "source-archive.sh: $pages is missing: build with the report page first" >&2; exit 1; }
for part in web/src/* web/build.mjs web/package-lock.json; do
  [[ ! $part -nt $pages ]] || { echo "source-archive.sh: $part is newer than the built pages: build again" >&2; exit 1; }
done
git diff --quiet HEAD -- || { echo "source-archive.sh: there are changes that are not committed" >&2; exit 1; }

archive=$folder/openflank-$version.tar.gz
git archive --format=tar --prefix="openflank-$version/web/built/" --add-file="$pages" --prefix="openflank-$version/" HEAD |
  gzip -n9 > "$archive"
echo "$archive"
