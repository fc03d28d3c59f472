# Everything starts here: `make book` and `make test` work on a machine that has only python3 and pip.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
UV := .boot/bin/uv
# One thread per process: results must not depend on how many cores a BLAS finds.
export OMP_NUM_THREADS := 1
export OPENBLAS_NUM_THREADS := 1
export MKL_NUM_THREADS := 1
export MPLBACKEND := agg
# uv reads no pip configuration; take the certificates of the system.
export UV_SYSTEM_CERTS := 1
export UV_NATIVE_TLS := 1

.DEFAULT_GOAL := help
.PHONY: help env shell book browser pdf lab notebooks-test test verify verify-portable trust trust-ledger faults install-matrix supply-chain supply-chain-check results arms metadata claims bench serve lint lock wheel clean

help:  ## list the targets
	@awk -F':.*## ' '/^[a-z-]+:.*## /{printf "  make %-19s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

env: $(VENV)/.installed  ## create the locked environment in .venv

shell: $(VENV)/.installed  ## open a shell in which the command `dualarm` is on the path
	@echo "dualarm is on the path of this shell; exit leaves it"
	@PATH="$(CURDIR)/$(BIN):$$PATH" VIRTUAL_ENV="$(CURDIR)/$(VENV)" exec "$${SHELL:-/bin/sh}"

book: $(VENV)/.installed  ## execute every notebook and build _build/html/index.html
	$(BIN)/python tools/prerun.py
	$(BIN)/jupyter-book build book -W -n --keep-going -q
	$(BIN)/dualarm export --out _build/html/_static/ledger
	$(BIN)/python tools/check_book.py

browser: $(VENV)/.installed  ## look at the built book in a browser, installed by apt where missing
	tools/install_chromium.sh
	$(BIN)/python tools/browser_check.py

pdf: $(VENV)/.installed  ## print the built book to _build/book.pdf
	tools/install_chromium.sh
	$(BIN)/python tools/book_pdf.py

lab: $(VENV)/.lab  ## open the pages as notebooks in JupyterLab
	$(BIN)/python tools/lab_notebooks.py _build/lab
	$(BIN)/jupyter lab _build/lab

notebooks-test: $(VENV)/.installed  ## run every notebook of the built book from a wheel, outside the clone
	$(BIN)/python tools/notebooks_test.py

test: $(VENV)/.installed  ## run the test suite; `make trust` runs the long tests
	$(BIN)/python tools/prerun.py --records
	$(BIN)/python -m pytest -n auto

verify: $(VENV)/.installed  ## recompute every item from nothing and compare with data/results
	$(BIN)/dualarm verify

verify-portable: $(VENV)/.installed  ## verify, then test, with the machine code of other processors
	$(BIN)/python tools/verify_portable.py --tests

trust: $(VENV)/.installed  ## attack everything, which takes hours, and write the figures of tests/README.md
	$(BIN)/python tools/trust.py

faults: $(VENV)/.installed  ## kills, full disks, bad caches, odd surroundings: count what survives
	$(BIN)/python tools/faults.py

trust-ledger: $(VENV)/.installed  ## change what is obtained, printed, assumed and the methods: all is noticed
	$(BIN)/python tools/trust_ledger.py

install-matrix: $(VENV)/.installed  ## install the wheel alone for every Python, bound and extra, and use it
	$(BIN)/python tools/install_matrix.py --resume

supply-chain: $(VENV)/.installed $(VENV)/.lab $(VENV)/.bench  ## write licences and bill of materials from the locks
	$(BIN)/python tools/supply_chain.py

supply-chain-check: $(VENV)/.installed  ## bill of materials, and secrets, machine paths or registries in files
	$(BIN)/python tools/supply_chain.py --check
	$(BIN)/python tools/check_leaks.py

arms: $(VENV)/.installed  ## recompute the table of public arms, data/results/public_arms.parquet
	$(BIN)/python tools/public_arms.py

results: $(VENV)/.installed  ## recompute and rewrite data/results and what pins them
	$(BIN)/dualarm verify --update
	$(BIN)/python tools/metadata.py

metadata: $(VENV)/.installed  ## write CITATION.cff, codemeta, Zenodo, RO-Crate and repro.yaml again
	$(BIN)/python tools/metadata.py

claims: $(VENV)/.installed  ## let tools that are not ours check citations, archives and numbers
	$(BIN)/dualarm export --out _build/ledger
	$(BIN)/claims verify repro.yaml --policy publication
	$(BIN)/claims verify _build/ledger/repro.yaml --policy publication
	$(BIN)/python tools/check_archive.py . _build/ledger

bench: $(VENV)/.bench  ## ratios against peers in one run, stored for the performance page
	$(BIN)/python benchmarks/run.py --threads --growth --store

serve:  ## open the built book
	$(PYTHON) -m webbrowser "file://$(CURDIR)/_build/html/index.html"

lint: $(VENV)/.installed  ## static checks: style, types, spelling
	$(BIN)/ruff check .
	$(BIN)/ruff format --check -q .
	$(BIN)/mypy
	$(BIN)/codespell

lock: | $(UV)  ## resolve the three lock files again
	$(UV) pip compile pyproject.toml --extra dev --group archive --universal --python-version 3.11 --generate-hashes -q -o requirements.lock
	$(UV) pip compile pyproject.toml --extra bench -c requirements.lock --universal --python-version 3.11 --generate-hashes -q -o requirements-bench.lock
	$(UV) pip compile pyproject.toml --extra dev --extra lab -c requirements.lock --universal --python-version 3.11 --generate-hashes -q -o requirements-lab.lock

wheel: $(VENV)/.installed  ## build a wheel that carries the data files
	$(BIN)/python -m hatchling build -t wheel

clean:  ## remove everything that was built, keep the environment
	rm -rf _build dist

$(UV):
	$(PYTHON) -m pip install -q --disable-pip-version-check --target .boot uv==0.13.9

# Where only pip reaches the registry, pip installs the same hashes.
$(VENV)/.installed: requirements.lock pyproject.toml | $(UV)
	test -x $(BIN)/python || $(UV) venv -q --python "$$(command -v $(PYTHON))" $(VENV)
	$(UV) pip sync -q --python $(BIN)/python --require-hashes requirements.lock \
	  || { rm -rf $(VENV) && $(PYTHON) -m venv $(VENV) \
	  && $(BIN)/python -m pip install -q --no-deps --require-hashes -r requirements.lock; }
	$(UV) pip install -q --python $(BIN)/python --no-deps --no-build-isolation -e .
	touch $@

$(VENV)/.bench $(VENV)/.lab: $(VENV)/.%: $(VENV)/.installed requirements-%.lock
	$(UV) pip install -q --python $(BIN)/python --require-hashes -r requirements-$*.lock
	touch $@
