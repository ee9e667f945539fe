# Two commands for a fresh Debian 12 machine. Both install the packages they need (only what is
# missing), then build and run.
#
#   make demo    a simulated robot maps an office; leaves demo/map.png and demo/topology.svg
#   make test    the whole test suite
#
# Further: make build, make package (a .deb), make PRESET=asan test, make clean.

PRESET ?= dev
JOBS ?= $(shell nproc)

.PHONY: demo test build setup package clean

demo: PRESET = release
demo: TARGETS = --target cairnd cairn_program cairn-sim cairn-hub
demo: build
	scripts/demo build/release

test: build
	ctest --preset $(PRESET) -j $(JOBS)

build: setup
	@cmake --preset $(PRESET) >build-$(PRESET).log 2>&1 || { cat build-$(PRESET).log; exit 1; }
	@rm -f build-$(PRESET).log
	cmake --build --preset $(PRESET) -j $(JOBS) $(TARGETS)

setup:
	@scripts/setup

package: setup
	cmake --preset release -DCAIRN_TESTS=OFF -DCAIRN_BENCH=OFF >/dev/null
	cmake --build --preset release -j $(JOBS)
	cpack --preset release

clean:
	rm -rf build
