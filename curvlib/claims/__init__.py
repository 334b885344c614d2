"""The paper's sentences: stated, decided, summed up."""
