# The one list of commands. Everything is installed into a virtual environment inside the repository.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
export CARGO_BUILD_JOBS ?= 2
# The build backend calls maturin by its name.
export PATH := $(CURDIR)/$(BIN):$(PATH)
STAMP := $(VENV)/.installed

.PHONY: demo study test test-rust test-python lint bench figures rivals trials proof rates bad-inputs fuzz moments \
	endurance wheel advisories third-party docs install clean

# The main job: identify the paper's twelve tests (a simulated replica) with both models and all swarms.
demo: install
	$(BIN)/mre-core demo --out demo

# Section 4 of the paper, claim by claim; the figures of docs/paper.md.
study: install
	$(BIN)/mre-core study --out study

test: test-rust test-python

test-rust:
	cargo test --locked -p mre

test-python: install
	$(BIN)/python -m pytest --numprocesses logical --maxprocesses 4 --dist loadfile --no-loadscope-reorder

lint: install
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --locked -- -D warnings
	RUSTDOCFLAGS="-D warnings" cargo doc --no-deps --locked -p mre
	$(BIN)/ruff format --check python tests benches docs
	$(BIN)/ruff check python tests benches docs
	$(BIN)/mypy
	$(BIN)/python -m mypy.stubtest mre_core._core

bench:
	cargo bench --locked -p mre-bench

# The figures of the README: fits of real recordings.
figures: install
	$(BIN)/python benches/real_fits.py

# Other packages on the same problems, side by side; writes benches/README.md.
rivals: install
	MATURIN_PEP517_ARGS=--locked $(BIN)/python -m pip install --quiet --no-build-isolation --editable '.[rivals]'
	$(BIN)/python benches/rivals
	$(BIN)/python benches/discovery --cases 10 --seed 7 --out docs/proof/rivals.md

# The diagnosis on concealed physics: a development seed.
trials: install
	rm -rf trial
	$(BIN)/mre-core trial make trial --cases 100 --seed 1
	$(BIN)/mre-core trial run trial
	$(BIN)/mre-core trial open trial

# The tables of docs/proof.md: SEED is a judging seed that was never run.
proof: install
	test -n "$(SEED)"
	$(BIN)/mre-core trial make judged --cases $(or $(CASES),600) --seed $(SEED)
	$(BIN)/mre-core trial run judged
	$(BIN)/mre-core trial open judged --tables docs/proof/judging
	$(BIN)/python benches/real_proof
	$(BIN)/python benches/proof.py

# How often the diagnosis is right, by experiment; SEED is a judging seed that was never run.
rates: install
	test -n "$(SEED)"
	for e in singles others pairs triples removed unknown nulls weak doubts located; do \
	  $(BIN)/python benches/rates $$e --cases $(or $(CASES),200) --seed $(SEED); done
	$(BIN)/python benches/proof.py

# Random input for about ten minutes, and every command stopped 200 times.
fuzz: install
	MRE_FUZZ=40 $(BIN)/python -m pytest tests/test_fuzz_core.py tests/test_fuzz_effects.py tests/test_fuzz_files.py

moments: install
	PYTHONPATH=tests $(BIN)/python -m moments 200

# Mixed work in one process for MINUTES: fails where memory, files, threads or processes are kept.
endurance: install
	PYTHONPATH=tests $(BIN)/python -m endurance $(or $(MINUTES),60)

# The wheel, made from the source distribution, in an empty environment of every Python found.
wheel: install
	rm -rf dist
	$(BIN)/maturin build --release --sdist --out dist
	PYTHONPATH=tests $(BIN)/python -m installation dist/*.whl

# Known vulnerabilities of everything installed and of every crate in Cargo.lock. Asks the Python Package Index and the
# advisory database of RustSec; fails where one of them cannot be reached.
advisories: install
	$(BIN)/python -m pip install --quiet "pip-audit>=2.10,<3"
	$(BIN)/python -m pip freeze --quiet --exclude-editable > $(VENV)/installed.txt
	$(BIN)/pip-audit --strict --no-deps --disable-pip --progress-spinner off --requirement $(VENV)/installed.txt
	cargo install --quiet --locked --root $(VENV) cargo-audit@0.22.2
	$(BIN)/cargo-audit audit --deny warnings

# The list of what others have made, with licences.
third-party: install
	PYTHONPATH=tests $(BIN)/python -m licences

# The page of bad inputs, from the table in tests/bad_inputs.
bad-inputs: install
	PYTHONPATH=tests $(BIN)/python -m bad_inputs

# The documentation, into the folder site: it opens from disk. A link that leads nowhere is an error.
docs: install
	$(BIN)/python -m pip install --quiet $$($(BIN)/python -c 'import tomllib; print(*tomllib.load(open("pyproject.toml", "rb"))["project"]["optional-dependencies"]["docs"])')
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict --quiet

install: $(STAMP)

# Built anew when any source of the package has changed.
$(STAMP): pyproject.toml Cargo.toml Cargo.lock $(shell find rust python -name '*.rs' -o -name '*.toml' -o -name '*.py' -o -name '*.pyi')
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet "maturin>=1.9.4,<2"
	MATURIN_PEP517_ARGS=--locked $(BIN)/python -m pip install --quiet --no-build-isolation --editable '.[dev]'
	touch $(STAMP)

clean:
	rm -rf $(VENV) target dist demo study site trial judged
