"""Published results of the Modelica Standard Library's examples, and the same machines in Python."""
