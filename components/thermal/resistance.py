"""Temperature dependence of an electrical resistance."""

from __future__ import annotations

from typing import Any


def resistance_ratio(T: Any, T_ref: Any, alpha20: Any) -> Any:
    """Ratio of resistances at T and T_ref: 1 + alpha (T - T_ref), alpha = alpha20 / (1 + alpha20 (T_ref - 293.15 K)).

    Parameters
    ----------
    T, T_ref : Expr
        Temperatures in K.
    alpha20 : Expr
        Linear temperature coefficient at 20 degrees Celsius in 1/K.
    """
    return 1 + alpha20 / (1 + alpha20 * (T_ref - 293.15)) * (T - T_ref)
