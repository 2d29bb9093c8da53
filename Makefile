# photonlab. `make help` lists the targets; one file, everything it makes lies under build/.

# --- what the user may set -----------------------------------------------------------------------
CC ?= cc
CXX ?= c++
CFLAGS ?= -O2 -g
CXXFLAGS ?= -O2 -g
SAN ?=
WERROR ?=

# --- parts from elsewhere, each found once --------------------------------------------------------
PREFIX ?= /usr
EMBREE_VERSION := $(if $(wildcard $(PREFIX)/include/embree4/rtcore.h),4,3)
VTK_INCLUDE := $(shell ls -d $(PREFIX)/include/vtk-* 2>/dev/null | sort -V | tail -1)
VTK_SUFFIX := $(patsubst vtk-%,%,$(notdir $(VTK_INCLUDE)))
PACKAGES := expat jansson libpng zlib assimp
PART_CFLAGS := $(shell pkg-config --cflags $(PACKAGES) OpenEXR 2>/dev/null | sed 's/-I/-isystem /g') -DPM_EMBREE=$(EMBREE_VERSION)
PART_LIBS := $(shell pkg-config --libs $(PACKAGES) 2>/dev/null) -lOpenEXRCore -lembree$(EMBREE_VERSION) -lm
GSL_LIBS := -lgsl -lgslcblas

# --- how our code is compiled ---------------------------------------------------------------------
BUILD := build/$(if $(SAN),san,ref)
BIN := build/bin$(if $(SAN),-san)
WARN := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wdouble-promotion -Wvla -Wformat=2 -Wundef \
  -Wwrite-strings -Wcast-qual -Wnull-dereference
WARN_C := $(WARN) -Wstrict-prototypes -Wmissing-prototypes
ifneq ($(findstring clang,$(shell $(CC) --version 2>/dev/null)),)
WARN_C += -Wcomma -Wmissing-variable-declarations
else
WARN_C += -Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wformat-signedness
endif
COMMON := -ffp-contract=off -fopenmp -MMD -MP -Icore $(if $(WERROR),-Werror)
ifneq ($(SAN),)
COMMON += -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
LINK := -fsanitize=address,undefined
endif
C_FLAGS := -std=c17 -D_XOPEN_SOURCE=700 $(WARN_C) $(COMMON) $(PART_CFLAGS)
CXX_FLAGS := -std=c++17 $(WARN) $(COMMON) -isystem $(VTK_INCLUDE)
LINK += -fopenmp

CORE := $(patsubst %.c,$(BUILD)/%.o,$(wildcard core/*.c))
RUNNER := $(patsubst %.c,$(BUILD)/%.o,$(wildcard tests/runner*.c))
TESTS := $(patsubst %.c,$(BUILD)/%.o,$(wildcard tests/test_*.c))

# --- programs -------------------------------------------------------------------------------------
DRIVER_emission := labs/01_emission/driver
DRIVER_tracing := labs/02_tracing/driver
DRIVER_storage := labs/03_storage/driver
DRIVER_balancing := labs/04_balancing/driver
DRIVER_radiance := labs/05_radiance/driver
DRIVER_filtering := labs/06_filtering/driver
DRIVER_render := labs/07_rendering/driver
DRIVER_compare := labs/07_rendering/compare
LAB_PROGRAMS := $(foreach p,emission tracing storage balancing radiance filtering render compare,\
  $(if $(wildcard $(DRIVER_$(p)).c),$(p)))
PROGRAMS := $(LAB_PROGRAMS:%=$(BIN)/%)

all: $(PROGRAMS)

.SECONDEXPANSION:
$(LAB_PROGRAMS:%=$(BIN)/%): $(BIN)/%: $(BUILD)/$$(DRIVER_%).o $(CORE)
	@mkdir -p $(@D)
	$(CC) $(LINK) $(LDFLAGS) -o $@ $^ $(PART_LIBS)

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) $(C_FLAGS) -c -o $@ $<

$(BUILD)/%.o: %.cc
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) $(CXX_FLAGS) -c -o $@ $<

# Programs are found beside the build by their full path, so a test may change its folder.
$(RUNNER): PART_CFLAGS += -DPM_TEST_BIN='"$(abspath $(BIN))"'

$(BUILD)/tests/run: $(RUNNER) $(TESTS) $(CORE)
	$(CC) $(LINK) $(LDFLAGS) -o $@ $(sort $^) $(PART_LIBS) $(GSL_LIBS)

test: $(BUILD)/tests/run $(PROGRAMS)
	$(BUILD)/tests/run $(ONLY)

clean:
	rm -rf build

.PHONY: all test clean
.DELETE_ON_ERROR:
-include $(CORE:.o=.d) $(TESTS:.o=.d) $(RUNNER:.o=.d)
