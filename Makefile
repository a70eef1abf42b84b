# The front door. What is missing on a Debian 12 is installed first, with apt, as root or through sudo.
#   make demo         builds the command and makes a gallery of models and pictures: out/gallery/index.html
#   make test         builds everything and runs all tests
#   make build        the command is then build/release/azulejo
#   make install      into PREFIX (/usr/local), with a CMake package: find_package(azulejo)
#   make reference    docs/operations, a page for each operation, and the pictures of docs/images.md
#   make bench        every operation beside its peer; updates the table in bench/README.md
#   make lint         format, clang-tidy, headers that compile alone
#   make asan         the tests under AddressSanitizer and UndefinedBehaviorSanitizer
#   make tsan         the tests under ThreadSanitizer
#   make fuzz-smoke   each fuzz target for FUZZ_SECONDS (20)

PREFIX ?= /usr/local
FUZZ_SECONDS ?= 20
JOBS ?= $(shell nproc)
CTEST = ctest --output-on-failure --parallel $(JOBS)

.PHONY: build demo test reference bench install lint asan tsan fuzz-smoke clean

build:
	@tools/install_packages needed
	cmake --preset release -DAZULEJO_TESTS=OFF
	cmake --build build/release --parallel $(JOBS)

demo: build
	@examples/models out/gallery/models
	@examples/tour build/release/azulejo out/gallery

test:
	@tools/install_packages needed tests
	cmake --preset release -DAZULEJO_TESTS=ON
	cmake --build build/release --parallel $(JOBS)
	$(CTEST) --test-dir build/release

reference: build
	cmake --build build/release --parallel $(JOBS) --target azulejo_reference
	build/release/azulejo_reference make build/release/azulejo . build/release/reference

bench:
	@tools/install_packages needed bench
	cmake --preset bench
	cmake --build build/bench --parallel $(JOBS)
	build/bench/azulejo_bench --markdown bench/README.md
	build/bench/render_costs bench bench/README.md
	bench/large_files build/bench bench/README.md

install: build
	cmake --install build/release --prefix $(PREFIX)

lint:
	@tools/install_packages needed tests lint
	tools/lint

asan:
	@tools/install_packages needed tests
	cmake --preset asan-ubsan
	cmake --build build/asan-ubsan --parallel $(JOBS)
	$(CTEST) --test-dir build/asan-ubsan

tsan:
	@tools/install_packages needed tests
	cmake --preset tsan
	cmake --build build/tsan --parallel $(JOBS)
	$(CTEST) --test-dir build/tsan

fuzz-smoke:
	@tools/install_packages needed fuzz
	cmake --preset fuzz
	cmake --build build/fuzz --parallel $(JOBS)
	tools/fuzz_smoke build/fuzz $(FUZZ_SECONDS)

clean:
	rm -rf build out
