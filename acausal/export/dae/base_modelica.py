"""The reduced DAE in Base Modelica."""
def base_modelica(compiled, p):
    return ""
