"""Studies of effects: switch each effect, and report what that changes and costs.

Modules in the order of imports: listing, effect_rows, variants and cheapest, effect_tables, effects_result, choices_file
and effects.
"""
