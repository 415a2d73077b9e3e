# Everything below is a line or two of CMake (CMakePresets.json); this file gives the lines their names.
# On a bare Debian 12 `make demo` and `make test` need only make, git and root (or sudo).
.DEFAULT_GOAL := build
.NOTPARALLEL:
.PHONY: build command deps demo test test-clients sanitize asan tsan bench fuzz install deb dist wheel docs format format-check words tidy clean help

JOBS ?= $(shell nproc)
SECONDS ?= 60
PREFIX ?= /usr/local
FLANK_DATA ?= $(CURDIR)/../shared/data
export FLANK_DATA

FLANK := build/release/apps/flank/flank

build:  ## build the release variant (command: build/release/apps/flank/flank)
	cmake --preset release
	cmake --build --preset release --parallel $(JOBS)

command: deps  ## build the command with the report page alone, without the tests
	cmake --preset release
	cmake --build --preset command --parallel $(JOBS)

deps:  ## install the Debian packages that a build needs, if any is missing
	scripts/install-deps.sh build

demo: command  ## make a twisted blade, fit a tool and its motion to it, and judge them
	mkdir -p out/demo
	$(FLANK) example twisted-blade -o out/demo/blade.step
	$(FLANK) fit out/demo/blade.step --face F1 -o out/demo
	$(FLANK) report out/demo || test $$? -eq 2  # built without the page: it has said why

test:  ## build and run all tests, those of the Python module among them; other programs open what we write in test-clients
	scripts/install-deps.sh build python
	cmake --preset release -D FLANK_PYTHON=ON  # without the module this would be no test of it: it fails and says what is lacking
	@ctest --preset release --show-only --label-regex '^python$$' | grep -q 'python\.' || \
	  { echo "make test: the tests of the Python module are left out: python3-pytest and python3-hypothesis are needed" >&2; exit 1; }
	cmake --build --preset release --parallel $(JOBS)
	ctest --preset release --parallel $(JOBS) --label-exclude '^clients$$'

test-clients: deps build  ## open what we write in Chromium, FreeCAD and LinuxCNC, sweep on Slurm; they are installed if they are missing
	scripts/install-deps.sh clients
	ctest --preset release --label-regex '^clients$$'

sanitize: asan tsan  ## run the tests under the address, undefined-behaviour and thread sanitizers

asan tsan:
	scripts/install-deps.sh build sanitizers
	scripts/sanitize.sh $@

fuzz:  ## fuzz every reader of our own for SECONDS (default 60); what is found lies in build/fuzz/found
	scripts/install-deps.sh build sanitizers
	cmake --preset fuzz
	cmake --build --preset fuzz --parallel $(JOBS)
	mkdir -p build/fuzz/found
	set -e; for program in $$(find build/fuzz/tests -name "fuzz_*" -type l | sort); do name=$${program##*/fuzz_}; \
	  mkdir -p build/fuzz/corpus/$$name; echo "== $$name"; \
	  $$program -max_total_time=$(SECONDS) -timeout=10 -rss_limit_mb=2000 -verbosity=0 -print_final_stats=1 \
	    -artifact_prefix=build/fuzz/found/$$name- build/fuzz/corpus/$$name $$(ls -d tests/fuzz/corpus/$$name 2>/dev/null); done

bench:  ## build and run the benchmarks
	scripts/install-deps.sh build bench
	cmake --preset bench
	cmake --build --preset bench --parallel $(JOBS)
	scripts/run-bench.sh build/bench/bench

install: deps build  ## install the command, the library and its headers under PREFIX
	cmake --install build/release --prefix $(PREFIX)

deb:  ## make Debian packages of the command, the library and the Python module, in build/packages
	scripts/install-deps.sh build python package
	cmake --preset release
	cmake --build --preset package --parallel $(JOBS)
	cpack --config build/release/CPackConfig.cmake -B build/packages

dist: build  ## make the source archive with the built pages, in build/packages
	scripts/source-archive.sh build/release build/packages

wheel:  ## make a wheel of the Python module, in build/packages
	scripts/install-deps.sh build python package
	cmake --preset release
	cmake --build --preset package --parallel $(JOBS)
	$$(sed -n "s/^FLANK_PYTHON_EXECUTABLE:[A-Z]*=//p" build/release/CMakeCache.txt) scripts/make_wheel.py build/release build/packages

docs:  ## make the site of the documents, build/docs/html/index.html
	scripts/install-deps.sh build python docs
	cmake --preset release
	cmake --build --preset package --parallel $(JOBS)
	PYTHONPATH=build/release/python \
	  $$(sed -n "s/^FLANK_PYTHON_EXECUTABLE:[A-Z]*=//p" build/release/CMakeCache.txt) scripts/make_docs.py build/docs

format:  ## format the sources in place
	scripts/install-deps.sh dev
	scripts/check-format.sh --fix

format-check:  ## check that the sources are formatted
	scripts/install-deps.sh dev
	scripts/check-format.sh

words:  ## check the documents: sentences, words, links, commands, figures
	scripts/check-words
	scripts/results.py --check

tidy:  ## lint the sources (clang-tidy), or with LAST=40 what the last 40 commits changed
	scripts/install-deps.sh build dev
	cmake --preset release -B build/tidy -D FLANK_BUILD_TESTS=OFF -D FLANK_UNITY=OFF -D FLANK_PRECOMPILE=OFF -D FLANK_REPORT=OFF
	scripts/tidy.py build/tidy $(if $(LAST),--last $(LAST))

clean:
	rm -rf build out

help:
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*##/ -/'
