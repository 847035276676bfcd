from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from acausal.structure import Plan, System

ROD = ("th", "om", "al", "rx", "ry", "vx", "vy", "ax", "ay", "fx", "fy", "tau")
ROD_RATE = {"th": "om", "om": "al", "rx": "vx", "ry": "vy", "vx": "ax", "vy": "ay"}


class Model:
    """A system with named variables: "x" after a bar, as in "a b | x", occurs explicitly."""

    def __init__(
        self,
        equations: Sequence[str],
        derivative: Mapping[str, str] | None = None,
        declared: Mapping[str, str] | None = None,
        defines: Mapping[int, str] | None = None,
        preference: Mapping[str, int] | None = None,
        names: str = "",
        closures: Mapping[int, str] | None = None,
    ) -> None:
        split = [(*e.split("|"), "")[:2] for e in equations]
        words = [*names.split(), *(w for e in split for part in e for w in part.split())]
        words += [w for pair in (derivative or {}).items() for w in pair]
        self.index = {name: k for k, name in enumerate(dict.fromkeys(words))}
        self.name = list(self.index)
        at = self.index
        self.system = System(
            rows=tuple(tuple(at[w] for part in e for w in part.split()) for e in split),
            explicit=tuple(frozenset(at[w] for w in e[1].split()) for e in split),
            derivative=tuple(at[derivative[n]] if n in (derivative or {}) else -1 for n in at),  # type: ignore[index]
            declared={at[n]: tuple(at[w] for w in row.split()) for n, row in (declared or {}).items()},
            defines=tuple(at[defines[k]] if k in (defines or {}) else -1 for k in range(len(split))),  # type: ignore[index]
            preference=tuple((preference or {}).get(n, 0) for n in at),
            closures={k: tuple(at[w] for w in row.split()) for k, row in (closures or {}).items()},
        )

    def names(self, plan: Plan, variables: Sequence[int]) -> list[str]:
        """Names, those of created variables with a prime; what is integrated in place of a coordinate in capitals."""
        name = list(self.name)
        for variable in plan.created:
            name.append(name[variable] + "'")
        name += ["mu"] * (plan.system.n_variables - len(name))
        for p in plan.constrained.projections:
            name[p.state], name[p.state_rate] = name[p.coordinate].upper(), name[p.coordinate].upper() + "'"
        return [name[v] for v in variables]


def freedom(plan: Plan) -> int:
    """States less the constraints on them."""
    return len(plan.states) - sum(len(c.rows) for c in plan.constrained.constraints)


def rods(n: int, closed: bool = False) -> Model:
    """Chain of `n` hinged planar rods with declared frame variables: 13 equations each; `closed` pins the end."""
    equations, defines, derivative, declared = [], {}, {}, {}
    for i in range(n):
        now = {name: f"{name}{i}" for name in (*ROD, "phi", "w", "z")}
        old = {name: f"{name}{i - 1}" if i else "" for name in ROD}
        new = {name: f"{name}{i + 1}" if i + 1 < n else ("lx" if name == "fx" else "ly") * closed for name in ROD}
        declared |= {now[name]: now[rate] for name, rate in ROD_RATE.items()}
        derivative |= {now["phi"]: now["w"], now["w"]: now["z"]}
        for name, row in (
            ("th", f"| {now['th']} {old['th']} {now['phi']}"),
            ("om", f"| {now['om']} {old['om']} {now['w']}"),
            ("al", f"| {now['al']} {old['al']} {now['z']}"),
            *((f"r{c}", f"{now['th']} | {now[f'r{c}']} {old[f'r{c}']}") for c in "xy"),
            *((f"v{c}", f"{now['th']} {now['om']} | {now[f'v{c}']} {old[f'v{c}']}") for c in "xy"),
            *((f"a{c}", f"{now['th']} {now['om']} {now['al']} | {now[f'a{c}']} {old[f'a{c}']}") for c in "xy"),
        ):
            if name in ROD_RATE:
                defines[len(equations)] = now[name]
            equations.append(row)
        equations += [f"| {now[f'f{c}']} {now[f'a{c}']} {new[f'f{c}']}" for c in "xy"]
        torque = new["tau"] if i + 1 < n else ""
        equations.append(f"{now['th']} {now['fx']} {now['fy']} | {now['al']} {now['tau']} {torque}")
        equations.append(f"| {now['tau']} {now['w']}")
    if closed:
        equations += [f"| rx{n - 1}", f"| ry{n - 1}"]
    return Model(equations, derivative, declared, defines)


def random_model(seed: int, n: int = 12, order: int = 2) -> tuple[np.ndarray, System]:
    """Random signature matrix (-1: absent) of a solvable system, and the system itself."""
    rng = np.random.default_rng(seed)
    signature = np.full((n, n), -1)
    signature[np.arange(n), rng.permutation(n)] = rng.integers(0, order + 1, n)
    extra = rng.random((n, n)) < 1.5 / n
    signature[extra] = np.maximum(signature[extra], rng.integers(0, order + 1, extra.sum()))
    highest = signature.max(axis=0)
    start = np.concatenate([[0], np.cumsum(highest + 1)])
    derivative = np.arange(1, start[-1] + 1)
    derivative[start[1:] - 1] = -1
    rows, explicit = [], []
    for line in signature:
        row = [int(start[j] + line[j]) for j in np.flatnonzero(line >= 0)]
        row += [v - 1 for v in row if v not in start and rng.random() < 0.3]
        rows.append(tuple(dict.fromkeys(row)))
        explicit.append(frozenset(v for v in row if rng.random() < 0.6))
    preference = tuple(int(p) for p in rng.integers(-2, 3, len(derivative)))
    system = System(tuple(rows), tuple(explicit), tuple(map(int, derivative)), {}, (-1,) * n, preference)
    return signature, system
