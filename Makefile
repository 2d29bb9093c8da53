# photonlab. One file; everything it makes lies under build/. `make help` lists the targets.
#
#   make BUILD=build/mine BIN=build/mine/bin all    keeps a second build beside the first
#   make SAN=1 test                                 address and undefined-behaviour sanitizers
#   make ONLY=store test                            the tests whose tag begins so
#   make V=1                                        whole commands instead of a line for each file

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SECONDEXPANSION:

# --- what the user may set -------------------------------------------------------------------
CC ?= cc
CXX ?= c++
CFLAGS ?= -O2 -g
CXXFLAGS ?= -O2 -g
PREFIX ?= /usr
SAN ?=
WERROR ?=
ONLY ?=
EXCEPT ?=
FULL ?=
V ?=
JOBS ?= $(shell nproc 2>/dev/null || echo 1)
BUILD := build/$(if $(SAN),san,ref)
BIN := build/bin$(if $(SAN),-san)

# --- parts from elsewhere: package, where it shows, who needs it, for what -------------------
# Read by `make deps` and `make doctor`. A part shows as a program on PATH or as a file under
# PREFIX; alternatives are separated by commas.
define PARTS
pkg-config        bin:pkg-config                     all      finds the compiler flags of the parts below
libexpat1-dev     include/expat.h                    all      scene files (XML)
libassimp-dev     include/assimp/cimport.h           all      meshes (PLY, OBJ)
libembree-dev     include/embree3/rtcore.h,include/embree4/rtcore.h all ray queries
librandom123-dev  include/Random123/philox.h         all      random numbers (Philox)
libopenexr-dev    include/OpenEXR/openexr.h          all      pictures in floating point (EXR)
libpng-dev        include/png.h                      all      pictures for the screen (PNG)
zlib1g-dev        include/zlib.h                     all      checksum of photon files
libjansson-dev    include/jansson.h                  all      reports (JSON)
libgsl-dev        include/gsl/gsl_cdf.h              tests    statistics, in the test programs only
g++               bin:g++                            view     compiles the files that call VTK
libvtk9-dev       include/vtk-9*                     view     pictures of photons, paths and trees
libwebp-dev       include/webp/mux.h                 tests    small pictures and films (WebP)
xvfb              bin:Xvfb                           tests    a display for the windows of `view`
xdotool           bin:xdotool                        tests    keys and mouse for these windows
libegl-dev        include/EGL/egl.h                  view     draws without a display
libgl1-mesa-dri   lib/*/dri/swrast_dri.so,lib/*/libgallium-*.so view draws without a graphics card
clang             bin:clang                          check    the second compiler
libomp-dev        lib/llvm-*/lib/libomp.so           check    threads for the second compiler
clang-format      bin:clang-format                   check    the layout of the sources
clang-tidy        bin:clang-tidy                     check    finds what compilers do not warn of
cppcheck          bin:cppcheck                       check    the same, by other means
valgrind          bin:valgrind                       bench    counts instructions
endef
export PARTS PREFIX

EMBREE := $(if $(wildcard $(PREFIX)/include/embree4/rtcore.h),4,3)
VTK_INCLUDE := $(lastword $(sort $(wildcard $(PREFIX)/include/vtk-9*)))
VTK_SUFFIX := $(patsubst vtk-%,%,$(notdir $(VTK_INCLUDE)))
PACKAGES := expat assimp libpng zlib jansson
PART_CFLAGS := -DPM_EMBREE=$(EMBREE) \
  $(shell pkg-config --cflags $(PACKAGES) OpenEXR 2>/dev/null | sed 's/-I/-isystem /g')
PART_LIBS := $(shell pkg-config --libs $(PACKAGES) 2>/dev/null) -lOpenEXRCore -lembree$(EMBREE) -lm
GSL_LIBS := -lgsl -lgslcblas
WEBP_LIBS := -lwebp -lwebpmux
# VTK has no pkg-config file in Debian 12.
VTK_MODULES := IOXML IOImage RenderingAnnotation RenderingOpenGL2 RenderingFreeType \
  InteractionStyle RenderingUI RenderingCore FiltersSources FiltersCore CommonColor \
  CommonExecutionModel CommonTransforms CommonDataModel CommonMath CommonCore ChartsCore \
  ViewsContext2D ViewsCore RenderingContextOpenGL2 RenderingContext2D sys
VTK_LIBS := -Wl,--as-needed $(VTK_MODULES:%=-lvtk%-$(VTK_SUFFIX)) -lGLEW -lEGL -ldl

# A make below this one, with as many jobs as there are cores unless told otherwise.
AGAIN = $(MAKE) --no-print-directory $(if $(findstring -j,$(MAKEFLAGS)),,-j$(JOBS))

# --- how our code is compiled -----------------------------------------------------------------
WARN := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion -Wvla -Wformat=2 \
  -Wundef -Wwrite-strings -Wcast-qual -Wnull-dereference
WARN_C := $(WARN) -Wstrict-prototypes -Wmissing-prototypes
ifneq ($(findstring clang,$(shell $(CC) --version 2>/dev/null)),)
WARN_C += -Wcomma -Wmissing-variable-declarations
else
WARN_C += -Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wformat-signedness
endif
SANITIZE := $(if $(SAN),-fsanitize=address -fsanitize=undefined -fno-sanitize-recover=all \
  -fno-omit-frame-pointer)
ROOMS := $(addprefix visualize/,views data figure)
# No contraction: clang would fuse multiply and add where gcc does not, and pictures differ.
COMMON := -ffp-contract=off -fopenmp -Icore $(ROOMS:%=-I%) $(SANITIZE)
SPEAK_C := -std=c17 -D_XOPEN_SOURCE=700 $(COMMON) $(PART_CFLAGS)
SPEAK_CXX := -std=c++17 $(COMMON) -isystem $(VTK_INCLUDE)
STRICTNESS := $(if $(WERROR),-Werror) -MMD -MP
COMPILE_C = $(CC) $(CFLAGS) $(SPEAK_C) $(WARN_C) $(STRICTNESS)
COMPILE_CXX = $(CXX) $(CXXFLAGS) $(SPEAK_CXX) $(WARN) $(STRICTNESS)
LINK = $(CC) -fopenmp $(SANITIZE) $(LDFLAGS)
LINK_CXX = $(CXX) -fopenmp $(SANITIZE) $(LDFLAGS)

# A recipe tells one short line and hides its command, unless V=1.
SHOW := $(filter-out 0,$(V))
HIDE := $(if $(SHOW),,@)
tell = $(if $(SHOW),,@echo '$(1)')

objects = $(patsubst %,$(BUILD)/%.o,$(basename $(1)))
CORE := $(call objects,$(wildcard core/*.c))
# What needs no VTK, for the tests; and what calls it.
VISUALIZE := $(call objects,$(filter-out visualize/views/view%,$(wildcard $(ROOMS:%=%/*.c))))
VIEWS := $(call objects,$(wildcard visualize/views/view*.c $(ROOMS:%=%/*.cc)))
RUNNER := $(call objects,$(wildcard tests/runner*.c))
TESTS := $(filter-out $(RUNNER),$(call objects,$(wildcard tests/*.c)))
BENCH_PROGRAMS := $(patsubst tests/bench/%.c,$(BUILD)/tests/bench/%,$(wildcard tests/bench/*.c))

# --- programs: a list of objects each ---------------------------------------------------------
MAIN_emission := labs/01_emission/driver
MAIN_tracing := labs/02_tracing/driver
MAIN_storage := labs/03_storage/driver
MAIN_balancing := labs/04_balancing/driver
MAIN_radiance := labs/05_radiance/driver
MAIN_filtering := labs/06_filtering/driver
MAIN_render := labs/07_rendering/driver
MAIN_reference := labs/07_rendering/reference
MAIN_compare := labs/07_rendering/compare
# What a program has beside its main object and core.
WITH_balancing := labs/04_balancing/tree labs/04_balancing/grown_tree labs/04_balancing/tree_dump \
  labs/04_balancing/visit_dump
WITH_filtering := labs/06_filtering/kernels labs/06_filtering/weighed
LAB_PROGRAMS := $(foreach p,emission tracing storage balancing radiance filtering render \
  reference compare,\
  $(if $(wildcard $(MAIN_$(p)).c),$(p)))
VIEW := $(if $(VTK_INCLUDE),$(BIN)/view)
NO_VIEW = echo "view is left out: VTK is missing; \`make deps\` installs libvtk9-dev"
PROGRAMS := $(LAB_PROGRAMS:%=$(BIN)/%) $(VIEW)

all: $(PROGRAMS) ## build the programs into build/bin
	@$(if $(VIEW),:,$(NO_VIEW))

$(LAB_PROGRAMS:%=$(BIN)/%): $(BIN)/%: $(BUILD)/$$(MAIN_%).o $$(call objects,$$(WITH_%)) $(CORE)
	@mkdir -p $(@D)
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $^ $(PART_LIBS)

$(BIN)/view: $(BUILD)/visualize/view.o $(VIEWS) $(VISUALIZE) $(CORE)
	@mkdir -p $(@D)
	$(call tell,link $@)
	$(HIDE)$(LINK_CXX) -o $@ $^ $(VTK_LIBS) $(WEBP_LIBS) $(PART_LIBS)

# The meshes are in git, so nothing else builds them.
MAKE_MESHES := $(BUILD)/scenes/meshes/make
meshes: $(MAKE_MESHES) ## write the meshes of the scenes again, byte for byte
	$< scenes/meshes

$(MAKE_MESHES): %: %.o $(BUILD)/core/file.o $(BUILD)/core/status.o
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $^ -lm

$(BUILD)/%.o: %.c $(BUILD)/flags | $(BUILD)/parts
	@mkdir -p $(@D)
	$(call tell,$(CC) $<)
	$(HIDE)$(COMPILE_C) $(DEFINE) -c -o $@ $<

$(BUILD)/%.o: %.cc $(BUILD)/flags | $(BUILD)/parts
	@mkdir -p $(@D)
	$(call tell,$(CXX) $<)
	$(HIDE)$(COMPILE_CXX) -c -o $@ $<

# Changes only when the compilers or their flags do; then everything is compiled anew.
$(BUILD)/flags: FORCE
	@mkdir -p $(@D)
	@echo '$(COMPILE_C) $(COMPILE_CXX)' | cmp -s - $@ || echo '$(COMPILE_C) $(COMPILE_CXX)' > $@

# Nothing is compiled before every required part has been seen once.
$(BUILD)/parts:
	@mkdir -p $(@D)
	@.ci/parts doctor > $@ || { cat $@; exit 2; }

# --- tests ------------------------------------------------------------------------------------
ATTACKS := $(BUILD)/tests/attacks
VTP := $(if $(VTK_INCLUDE),$(BUILD)/tests/vtp/print)
CHARTS := $(if $(VIEW),$(BUILD)/tests/charts/sample)
# Tests find programs by their full path, so that a test may change its folder.
$(RUNNER): DEFINE = -DPM_TEST_BIN='"$(abspath $(BIN))"' $(if $(VIEW),,-DPM_TEST_WITHOUT='" view "')
$(BUILD)/tests/test_runner.o: DEFINE = -DPM_TEST_ATTACKS='"$(abspath $(ATTACKS))"'
$(BUILD)/tests/test_chart.o: DEFINE = -DPM_TEST_CHARTS='"$(abspath $(CHARTS))"'
$(BUILD)/tests/test_scenes.o: DEFINE = -DPM_TEST_MESHES='"$(abspath $(MAKE_MESHES))"'
$(BUILD)/tests/test_view_vtp.o: DEFINE = -DPM_TEST_VTP='"$(abspath $(BUILD)/tests/vtp/print)"'
$(TESTS): DEFINE += -Itests

$(BUILD)/tests/run: $(RUNNER) $(TESTS) $(CORE) $(VISUALIZE)
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $(sort $^) $(PART_LIBS) $(GSL_LIBS) $(WEBP_LIBS) -lwebpdemux

$(ATTACKS): $(BUILD)/tests/runner/attacks.o $(RUNNER) $(BUILD)/core/status.o
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $^ $(PART_LIBS)

$(CHARTS): %: %.o $(call objects,$(wildcard visualize/figure/*.c*)) $(CORE)
	$(call tell,link $@)
	$(HIDE)$(LINK_CXX) -o $@ $^ $(VTK_LIBS) $(WEBP_LIBS) $(PART_LIBS)

# Reads .vtp files by VTK, which the tests do not link.
$(VTP): %: %.o
	$(call tell,link $@)
	$(HIDE)$(LINK_CXX) -o $@ $< $(VTK_LIBS) $(PART_LIBS)

build-tests: all $(BUILD)/tests/run $(ATTACKS) $(CHARTS) $(MAKE_MESHES) $(VTP)

test: ## build, then run the tests (ONLY=tag for some, SAN=1 with sanitizers)
	@$(AGAIN) build-tests
	@$(if $(SAN),,$(AGAIN) $(BIN)/render-without-caustics)
	@OMP_WAIT_POLICY=passive LSAN_OPTIONS=suppressions=$(CURDIR)/tests/leaks.supp:print_suppressions=0 \
	  $(BUILD)/tests/run $(if $(SAN),--limit 300) $(if $(EXCEPT),--without '$(EXCEPT)') $(ONLY)

# --- everything in one go ---------------------------------------------------------------------
demo: ## install what is missing, build, render the Cornell box and picture its photons
	@$(MAKE) --no-print-directory deps
	@$(AGAIN) all
	@labs/demo.sh $(BIN)

gallery: all ## render every scene at two qualities, all on one sheet
	@visualize/gallery.sh $(BIN)

# Committed figures are compared with a tolerance: libraries draw edges a little differently.
ALIKE := $(BUILD)/tests/figures/alike
figures: all $(ALIKE) ## draw every figure of README, hand-outs and slides (ONLY=labs/03 for some)
	@$(if $(VIEW),visualize/figures.sh draw $(BIN) $(ALIKE),$(NO_VIEW); exit 2)

check-figures: all $(ALIKE)
	@$(if $(VIEW),visualize/figures.sh check $(BIN) $(ALIKE),$(NO_VIEW))

$(ALIKE): %: %.o
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $< -lpng -lwebpdemux -lwebp

# quality takes an hour, so it runs when it is named.
BENCHES := promises plan direct caustics precompute projection $(if $(VIEW),views) \
  $(filter quality,$(ONLY))
bench: all $(BENCH_PROGRAMS) $(BIN)/render-without-caustics ## measure against the promises (ONLY=plan for one)
	@for b in $(filter $(ONLY)%,$(BENCHES)); do \
	  echo "$$b:"; tests/bench/run $(BUILD) $(BIN) $$b || exit; done

$(BENCH_PROGRAMS): %: %.o $(CORE)
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $^ $(PART_LIBS)

# Our sources less what is only there for caustics: a picture without any must cost the same.
WITHOUT := $(BUILD)/without-caustics
EDITED := $(patsubst tests/bench/without-caustics/%.sed,$(WITHOUT)/core/%.o,\
  $(wildcard tests/bench/without-caustics/*.sed))
$(EDITED:.o=.c): $(WITHOUT)/core/%.c: core/%.c tests/bench/without-caustics/%.sed tests/bench/edit
	@mkdir -p $(@D)
	$(call tell,edit $<)
	$(HIDE)tests/bench/edit tests/bench/without-caustics/$*.sed $< $@

$(EDITED): %.o: %.c $(BUILD)/flags
	$(call tell,$(CC) $<)
	$(HIDE)$(COMPILE_C) -Wno-unused-parameter -c -o $@ $<

$(BIN)/render-without-caustics: $(BUILD)/$(MAIN_render).o $(EDITED) \
  $(filter-out $(EDITED:$(WITHOUT)/%=$(BUILD)/%),$(CORE))
	@mkdir -p $(@D)
	$(call tell,link $@)
	$(HIDE)$(LINK) -o $@ $^ $(PART_LIBS)

# --- what CI does -----------------------------------------------------------------------------
SOURCES = $(shell git ls-files '*.c' '*.h' '*.cc' '*.hh')
# Off: it does not see that memory is handed over, nor that PM_OK means that outputs were
# written, takes `count` for a constant, and minds locals called like a static verb.
CPPCHECK_OFF := memleak uninitvar knownConditionTrueFalse shadowFunction
TIDY_C = $(filter-out tests/%,$(filter %.c,$(SOURCES)))
# VTK's headers take clang-tidy minutes.
TIDY_CXX = $(if $(FULL),$(if $(VTK_INCLUDE),$(filter %.cc,$(SOURCES))))

# Pictures against pictures, minutes long under sanitizers; FULL=1 runs them there, too.
NUMBERS := $(if $(FULL),,peers agreement)

check: ## all that CI does: layout, lint, both compilers, tests, sanitizers (FULL=1: C++ lint)
	@$(MAKE) --no-print-directory check-format
	@$(MAKE) --no-print-directory check-lint
	@$(AGAIN) build-tests WERROR=1 CC=clang CXX=clang++ BUILD=build/clang BIN=build/clang/bin \
	  CFLAGS=-O0 CXXFLAGS=-O0
	@$(MAKE) --no-print-directory test WERROR=1 CC=gcc CXX=g++
	@$(MAKE) --no-print-directory check-figures WERROR=1 CC=gcc CXX=g++
	@$(MAKE) --no-print-directory test SAN=1 WERROR=1 CC=gcc CXX=g++ CXXFLAGS='-O0 -g' EXCEPT='$(NUMBERS)'

check-format:
	$(call tell,check the layout of $(words $(SOURCES)) files)
	$(HIDE)clang-format --dry-run -Werror $(SOURCES)

check-lint:
	$(call tell,clang-tidy $(words $(TIDY_C)) C files)
	$(HIDE)printf '%s\n' $(TIDY_C) | xargs -P $(JOBS) -I{} clang-tidy --quiet {} -- $(SPEAK_C) $(WARN)
	$(call tell,clang-tidy $(words $(TIDY_CXX)) C++ files)
	$(HIDE)printf '%s\n' $(TIDY_CXX) | xargs -r -P $(JOBS) -I{} clang-tidy --quiet {} -- $(SPEAK_CXX) $(WARN)
	$(call tell,cppcheck $(words $(TIDY_C)) C files)
	$(HIDE)cppcheck --quiet --std=c11 --language=c --error-exitcode=1 -j $(JOBS) -Icore -Itests \
	  --enable=warning,style,performance,portability $(CPPCHECK_OFF:%=--suppress=%) $(TIDY_C)

tidy: ## lay out the sources as .clang-format says
	@clang-format -i $(SOURCES)

format: tidy

clean: ## remove everything that was built
	@rm -rf build

# --- the machine ------------------------------------------------------------------------------
deps: ## install the parts from elsewhere (Debian 12 or newer, Ubuntu 24.04 or newer)
	@.ci/parts install

doctor: ## list the parts: found, or the package that holds them
	@.ci/parts doctor

help: ## list these targets
	@sed -n 's/^\([a-z-]*\):[^#]*## /\1\t/p' Makefile | while IFS="$$(printf '\t')" read -r name does; do \
	  printf '  make %-8s %s\n' "$$name" "$$does"; done

FORCE:
.PHONY: FORCE all meshes build-tests test demo gallery figures check-figures bench check check-format check-lint tidy format \
  clean deps doctor help
-include $(wildcard $(BUILD)/*/*.d $(BUILD)/*/*/*.d)
