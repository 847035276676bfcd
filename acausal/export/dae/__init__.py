"""Open DAEs: archives of models that are read without the classes that made them."""
