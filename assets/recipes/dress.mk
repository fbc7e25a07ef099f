# Dresses every pattern of a folder that is newer than its result:
#   make -f dress.mk -j 4 -k PATTERNS=patterns OUT=out OPTIONS='--body body.obj --no-picture'
# With -k one that cannot be dressed does not stop the others; the exit code of make tells that there was one.
PATTERNS ?= patterns
OUT ?= out
OPTIONS ?=
TOILE ?= toile

reports := $(patsubst $(PATTERNS)/%.json,$(OUT)/%/report.json,$(wildcard $(PATTERNS)/*.json))

.PHONY: all
all: $(reports)

$(OUT)/%/report.json: $(PATTERNS)/%.json
	$(TOILE) dress $< --out $(@D) --threads 1 $(OPTIONS)
