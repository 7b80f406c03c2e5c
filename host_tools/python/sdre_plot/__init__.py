# SPDX-License-Identifier: MIT
"""How traces and spectra are drawn, by matplotlib; sdre-sil runs the files as scripts, sdre imports
them."""
