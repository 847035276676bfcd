"""Open DAEs: archives of models that can be read without the models' classes."""
