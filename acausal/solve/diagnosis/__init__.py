"""Diagnosis of failures: equations and values that cause them, and remedies."""
