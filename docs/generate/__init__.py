"""Pages and pictures of the site that follow from the code: components, scenes, formulas."""
