"""Numerical integration with point sets: estimators, variances and integrands."""
