"""Building the library: by the installation of a checkout, and for all platforms by makers of wheels."""
